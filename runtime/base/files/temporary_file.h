// runtime/base/files/temporary_file.h: files under names of their own until they are whole.
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "runtime/base/regular_file.h"

namespace kinora {

// A file beside the one that it becomes: ".NAME.kinora.HOST.BOOT.PID.RANDOM.tmp". Machines that
// share the folder differ in one of these, and so do containers, whose processes all have the
// number 1. Results are 0 or the system's error number.
class TemporaryFile {
  public:
    TemporaryFile() = default;
    ~TemporaryFile() { drop(); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    // Makes it, for reading and writing. The folder is there already.
    int open(const std::string& path, mode_t mode = 0666);
    std::FILE* stream() const { return file_.get(); }
    // All that was written is on the disk and has the final name; else no file is left.
    int commit();
    // Removes it.
    void drop();

  private:
    int sync();

    std::string path_, name_;
    OpenFile file_;
    int slot_ = -1;  // of the names that unlink_temporaries() removes
};

// A new name of that form for `path`; each call gives another one.
std::string temporary_name(const std::string& path);
// Whether the name, without folder, has that form.
bool is_temporary_name(std::string_view name);

// Removes those in the folder of `path` that have not changed for a day: their writers were killed.
// Whether a writer lives is not known, since it may be on another machine.
void remove_old_temporaries(const std::string& path);

// Removes those that are open now. Async-signal-safe: for a process that ends at once.
void unlink_temporaries() noexcept;

// Writes the whole file, or leaves what was there.
int write_whole_file(const std::string& path, std::string_view bytes, mode_t mode = 0666);

// Replaces a file, or the one that a link leads to. Its permissions stay.
int replace_file(const std::string& path, std::string_view bytes);

// Makes the folder of `path` and those above it.
int make_folder_of(const std::string& path);

}  // namespace kinora
