// runtime/programs/convert/folder_p.h: kinora-convert -r: the files of a folder, and what became of
// each.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/programs/convert/convert.h"

namespace kinora {

// A scene file of the folder. Paths are relative to the folders, with '/'.
struct FolderFile {
    std::string input, output;
    uint64_t size = 0;
    int64_t changed = 0;  // nanoseconds
};

// All scene files below the options' input, sorted. Each keeps its place in the tree and its name
// with the new extension; files that would get one name keep their own extension before it.
std::vector<FolderFile> folder_files(const ConvertOptions& options);

struct ReportedFinding {
    std::string code, severity, message;
    std::string place;  // "file:line:column"; "" for none
};

enum class Outcome : uint8_t { Converted, Failed, Crashed, NotTried };

struct FileRecord {
    FolderFile file;
    Outcome outcome = Outcome::NotTried;
    int code = 0;        // the exit code, or the signal of what crashed
    uint64_t bytes = 0;  // of the output
    std::vector<ReportedFinding> findings;
    std::string said;   // on stderr, where it is no finding
    bool kept = false;  // from an earlier run

    size_t lost() const;
};

// --- the record of a run, so that the next one takes up where it ended ---------------------------

// A line for each finished file, in the output's folder.
class FolderJournal {
  public:
    // Reads what an earlier run with the same options left. Returns an exit code: another run holds
    // it, or it cannot be written.
    int open(const ConvertOptions& options);
    ~FolderJournal();

    // The record of a file that was converted as it is now, and whose output is still there.
    std::optional<FileRecord> find(const FolderFile& file) const;
    void add(const FileRecord& record);

  private:
    std::string folder_, settings_;
    std::vector<FileRecord> records_;
    int file_ = -1;
};

// Text, or JSON where the name ends in .json.
std::string folder_report(const ConvertOptions& options, const std::vector<FileRecord>& records);
std::string record_line(const FileRecord& record, const std::string& settings);
std::optional<FileRecord> parse_record(const std::string& line, const std::string& settings);

// What a conversion found, from the process that made it.
std::string findings_text(const Diagnostics& diagnostics);
std::vector<ReportedFinding> parse_findings(const std::string& text);

// --- processes: one a file, so that a crash costs that file alone --------------------------------

class ConversionProcess {
  public:
    // False where none can be started.
    bool start(const ConvertOptions& options, const FolderFile& file);
    int pid() const { return pid_; }
    // With the status that waitpid gave.
    FileRecord finish(int status) const;

  private:
    int pid_ = -1;
    int findings_ = -1, said_ = -1;  // files without a name
    FolderFile file_;
    std::string output_;
};

}  // namespace kinora
