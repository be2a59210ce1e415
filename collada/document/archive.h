// collada/document/archive.h: .zae and .kmz: a zip unpacked into a private folder, for a time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/diagnostic.h"

namespace kinora::collada {

// What an archive may ask of memory and disk. Counted on what is really unpacked, not on what the
// zip says of itself.
struct ArchiveLimits {
    uint64_t members = 20'000;
    uint64_t unpacked_bytes = uint64_t(4) << 30;  // of all members together
    uint64_t ratio = 200;                         // unpacked bytes for one of the archive, where
    uint64_t free_bytes = uint64_t(64) << 20;     // more than this is unpacked
};

// A folder of our own below $TMPDIR or /tmp, mode 0700, removed with everything in it at the end.
// Folders that a killed process left behind are removed by the next one.
class PrivateFolder {
  public:
    // Nothing, and `error`, when none can be made.
    static std::shared_ptr<const PrivateFolder> make(std::string& error);
    ~PrivateFolder();
    PrivateFolder(const PrivateFolder&) = delete;
    PrivateFolder& operator=(const PrivateFolder&) = delete;
    const std::string& path() const {
        return path_;
    }  // absolute, links followed, no '/' at its end

  private:
    PrivateFolder(std::string path, int lock) : path_(std::move(path)), lock_(lock) {}
    std::string path_;
    int lock_;
};

// True for a file, or the bytes of one, that begins as a zip does.
bool is_archive(const std::string& path);
bool is_archive_bytes(std::string_view bytes);

struct Archive {
    std::shared_ptr<const PrivateFolder> folder;
    std::vector<std::string> members;  // paths below the folder, in the archive's order
};

// Unpacks every member that may be: none outside the folder, no links, none encrypted (each left
// out is ARCHIVE_MEMBER). Findings call member M of the archive "path!M" from now on. Nothing, and
// an Error, when it is no zip or passes a limit.
std::optional<Archive> unpack_archive(const std::string& path, const ArchiveLimits& limits,
                                      Diagnostics& diag);
std::optional<Archive> unpack_archive_bytes(const std::string& path, std::string_view bytes,
                                            const ArchiveLimits& limits, Diagnostics& diag);

}  // namespace kinora::collada
