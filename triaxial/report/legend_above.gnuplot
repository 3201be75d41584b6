# The legend in one row above the frame, where no curve can be. gnuplot takes letters for wider than
# they are: with what `width` takes off, a row holds what it has room for.
set key above left horizontal Left reverse maxrows 1 samplen 2 width -3
