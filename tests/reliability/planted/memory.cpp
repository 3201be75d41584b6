// Reads a number that nobody wrote and one behind the end of an array. With GOOD, neither.

#include <cstdio>
#include <cstdlib>

int main(int argc, char**) {
#ifdef GOOD
    const int at = argc - 1;
#else
    const int at = argc + 7;
#endif
    int* numbers = static_cast<int*>(std::malloc(8 * sizeof(int)));
    if (numbers == nullptr) return 1;
#ifdef GOOD
    for (int i = 0; i < 8; ++i) numbers[i] = i;
#endif
    if (numbers[at] + numbers[at / 8] > 100) std::puts("large");
    std::free(numbers);
}
