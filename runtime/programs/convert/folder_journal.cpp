// runtime/programs/convert/folder_journal.cpp: finished files of a folder, one line each.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/convert/folder_p.h"

namespace kinora {

namespace fs = std::filesystem;

namespace {

constexpr const char* kJournal = ".kinora-convert.jsonl";

// What changes the bytes of an output.
std::string settings_of(const ConvertOptions& o) {
    std::string text = fmt::format("{} {} {} {} {} {} {} {} {}", KINORA_VERSION, o.input, o.to,
                                   o.animation_error, o.confine, o.copy_textures, o.findings.strict,
                                   o.meter.value_or(0), o.up_axis ? int(*o.up_axis) : -1);
    for (const auto& [pattern, shader] : o.shaders) text += fmt::format(" {}={}", pattern, shader);
    for (const std::string& folder : o.include_directories) text += " -I" + folder;
    for (const std::string& folder : o.allow_external) text += " +" + folder;
    return text;
}

}  // namespace

int FolderJournal::open(const ConvertOptions& options) {
    folder_ = options.output;
    settings_ = settings_of(options);
    std::error_code code;
    fs::create_directories(folder_, code);
    std::string path = (fs::path(folder_) / kJournal).string();
    file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (file_ < 0) {
        fmt::print(stderr, "kinora: error: cannot write '{}': {}\n", path, std::strerror(errno));
        return kExitUnwritable;
    }
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
        fmt::print(stderr, "kinora: error: another kinora-convert writes into '{}'\n", folder_);
        return kExitRetry;
    }
    std::ifstream lines(path);
    bool torn = false;
    for (std::string line; std::getline(lines, line); torn = lines.eof())
        if (std::optional<FileRecord> record = parse_record(line, settings_))
            records_.push_back(std::move(*record));
    // A line that a killed run did not finish ends here.
    return !torn || ::write(file_, "\n", 1) == 1 ? kExitOk : kExitUnwritable;
}

FolderJournal::~FolderJournal() {
    if (file_ >= 0) ::close(file_);
}

std::optional<FileRecord> FolderJournal::find(const FolderFile& file) const {
    auto known = std::find_if(records_.rbegin(), records_.rend(), [&](const FileRecord& r) {
        return r.file.input == file.input && r.file.output == file.output;
    });
    if (known == records_.rend() || known->outcome != Outcome::Converted) return std::nullopt;
    std::error_code code;
    bool is_same = known->file.size == file.size && known->file.changed == file.changed &&
                   fs::file_size(fs::path(folder_) / file.output, code) == known->bytes && !code;
    if (!is_same) return std::nullopt;
    FileRecord record = *known;
    record.kept = true;
    return record;
}

void FolderJournal::add(const FileRecord& record) {
    std::string line = record_line(record, settings_) + "\n";
    // One call: lines of a run that is killed are whole or the last.
    if (::write(file_, line.data(), line.size()) != ssize_t(line.size()))
        fmt::print(stderr, "kinora: warning: the next run will convert '{}' again\n",
                   record.file.input);
}

}  // namespace kinora
