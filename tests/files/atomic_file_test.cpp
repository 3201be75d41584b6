#include "core/files/atomic_file.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"
#include "tests/files/sample.hpp"

namespace grainfield::core {
namespace {

using testing::HasSubstr;
class AtomicFileTest : public FilesTest {};

/// A stand-in for a full disk: no file may grow beyond this many bytes.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &old_);
        const rlimit limit{bytes, old_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &old_);
        std::signal(SIGXFSZ, handler_);
    }

  private:
    void (*handler_)(int);
    rlimit old_{};
};

TEST_F(AtomicFileTest, WritesNewAndReplacesOld) {
    const auto path = in_folder("a.txt");
    write_file_atomically(path, "one");
    EXPECT_EQ(read_whole_file(path), "one");
    write_file_atomically(path, std::string("t\0o", 3));
    EXPECT_EQ(read_whole_file(path), std::string("t\0o", 3));
    write_file_atomically(path, "");
    EXPECT_EQ(read_whole_file(path), "");
    EXPECT_EQ(entries(), 1u) << "a temporary was left";
}

TEST_F(AtomicFileTest, AFullDiskLosesNothing) {
    const auto path = text_file("a.txt", "old");
    const std::string large(200000, 'x');
    std::string message;
    {
        const FileSizeLimit limit(65536);
        message = message_of<FileError>([&] { write_file_atomically(path, large); });
    }
    EXPECT_THAT(message, HasSubstr(path.string() + ": cannot be written: File too large"));
    EXPECT_EQ(read_whole_file(path), "old");
    EXPECT_EQ(entries(), 1u) << "a temporary was left";
}

TEST_F(AtomicFileTest, AFullDiskLosesNoSphereFileOfAnyFormat) {
    const SphereFile sample = make_sample(2000);
    for (const char* name : {"a.h5", "a.csv", "a.data", "a.txt"}) {
        const auto path = text_file(name, "old");
        {
            const FileSizeLimit limit(32768);
            EXPECT_THROW(write_spheres(path, sample), FileError) << name;
        }
        EXPECT_EQ(read_whole_file(path), "old") << name;
    }
    EXPECT_EQ(entries(), 4u);
}

TEST_F(AtomicFileTest, NamesFileAndReason) {
    const auto file = text_file("file", "old");
    const auto below = file / "below.csv";
    EXPECT_EQ(message_of<FileError>([&] { write_file_atomically(below, "x"); }),
              below.string() + ": cannot be written: Not a directory");
    EXPECT_EQ(read_whole_file(file), "old");
    const auto missing = in_folder("no/such.csv");
    EXPECT_EQ(message_of<FileError>([&] { write_file_atomically(missing, "x"); }),
              missing.string() + ": cannot be written: No such file or directory");
    EXPECT_EQ(message_of<FileError>([&] { write_file_atomically(folder, "x"); }),
              folder.string() + ": cannot be written: Is a directory");
    EXPECT_EQ(message_of<FileError>([&] { read_whole_file(missing); }),
              missing.string() + ": cannot be read: No such file or directory");
    EXPECT_EQ(message_of<FileError>([&] { read_whole_file(folder); }),
              folder.string() + ": cannot be read: Is a directory");
}

TEST_F(AtomicFileTest, FollowsLinksAndSparesDevices) {
    const auto real = text_file("real", "old");
    std::filesystem::create_symlink(real, in_folder("link"));
    write_file_atomically(in_folder("link"), "new");
    EXPECT_TRUE(std::filesystem::is_symlink(in_folder("link")));
    EXPECT_EQ(read_whole_file(real), "new");
    EXPECT_THAT(message_of<FileError>([] { write_file_atomically("/dev/null", "x"); }),
                HasSubstr("not a regular file"));
}

TEST_F(AtomicFileTest, ForLibrariesThatWriteByPath) {
    const auto path = text_file("a.txt", "old");
    {
        const AtomicFile abandoned(path);
        std::ofstream(abandoned.path()) << "half";
        EXPECT_EQ(abandoned.path().parent_path(), folder);
        EXPECT_EQ(entries(), 2u);
    }
    EXPECT_EQ(entries(), 1u);
    EXPECT_EQ(read_whole_file(path), "old");
    AtomicFile file(path);
    std::ofstream(file.path()) << "new";
    EXPECT_EQ(read_whole_file(path), "old");
    file.commit();
    EXPECT_EQ(read_whole_file(path), "new");
    EXPECT_EQ(entries(), 1u);
}

}  // namespace
}  // namespace grainfield::core
