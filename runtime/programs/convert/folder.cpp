// runtime/programs/convert/folder.cpp: kinora-convert -r: all scene files of a folder.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <map>
#include <set>

#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/convert/folder_p.h"
#include "runtime/programs/convert/write_whole_p.h"

namespace kinora {

namespace fs = std::filesystem;

namespace {

volatile std::sig_atomic_t stopped_by = 0;

void catch_stops() {
    struct sigaction action {};
    action.sa_handler = [](int signal) { stopped_by = signal; };
    for (int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

// ".NAME.ANYTHING.tmp" of one of these names.
bool is_temporary_of(const std::string& file, const std::set<std::string>& names) {
    if (!file.starts_with(".") || !file.ends_with(".tmp")) return false;
    for (size_t dot = file.find('.', 1); dot != file.npos; dot = file.find('.', dot + 1))
        if (names.contains(file.substr(1, dot - 1))) return true;
    return false;
}

class FolderConversion {
  public:
    explicit FolderConversion(const ConvertOptions& options)
        : options_(options), files_(folder_files(options)), records_(files_.size()) {
        options_.threads = options.threads ? options.threads : 1;
        for (size_t f = 0; f < files_.size(); ++f) records_[f].file = files_[f];
    }

    int run() {
        if (files_.empty()) {
            fmt::print(stderr, "kinora: error: no scene files in '{}'\n", options_.input);
            return kExitUnreadable;
        }
        if (int code = journal_.open(options_)) return code;
        remove_temporaries();
        catch_stops();
        for (size_t f = 0; f < files_.size() && !stopped_by; ++f) {
            if (std::optional<FileRecord> known = journal_.find(files_[f])) {
                records_[f] = std::move(*known);
                continue;
            }
            while (running_.size() >= size_t(options_.jobs) && !stopped_by) wait_for_one();
            if (!stopped_by) start(f);
        }
        stop_running();
        while (!running_.empty()) wait_for_one();
        return finish();
    }

  private:
    void start(size_t f) {
        ConversionProcess process;
        if (process.start(options_, files_[f])) {
            running_.emplace(process.pid(), std::pair(f, process));
            return;
        }
        records_[f].outcome = Outcome::Failed;
        records_[f].code = kExitRetry;
        records_[f].said = "no process can be started";
    }

    // What a run that was killed left half written. No process writes yet, and this run alone will
    // (FolderJournal).
    void remove_temporaries() const {
        std::map<fs::path, std::set<std::string>> outputs;  // by their folder
        for (const FolderFile& file : files_) {
            fs::path output = fs::path(options_.output) / file.output;
            outputs[output.parent_path()].insert(output.filename().string());
            outputs[output.parent_path()].insert(output.stem().string() + ".bin");
        }
        std::vector<fs::path> old;
        std::error_code code;
        for (const auto& [folder, names] : outputs)
            for (const auto& entry : fs::directory_iterator(folder, code))
                if (is_temporary_of(entry.path().filename().string(), names))
                    old.push_back(entry.path());
        for (const fs::path& path : old) fs::remove(path, code);
    }

    void wait_for_one() {
        int status = 0;
        pid_t pid = waitpid(-1, &status, 0);
        if (pid < 0 && errno == EINTR) return stop_running();
        auto found = running_.find(pid);
        if (found == running_.end()) return;
        auto [f, process] = found->second;
        running_.erase(found);
        FileRecord record = process.finish(status);
        // What this run itself stopped is no crash of the file's.
        if (stopped_by && record.outcome == Outcome::Crashed) return;
        records_[f] = std::move(record);
        journal_.add(records_[f]);
        tell(records_[f]);
    }

    void stop_running() {
        for (const auto& [pid, process] : running_)
            if (stopped_by) kill(pid, SIGTERM);
    }

    void tell(const FileRecord& r) const {
        if (r.outcome == Outcome::Converted) {
            if (!options_.findings.quiet)
                fmt::print(stderr, "{} -> {}{}\n", r.file.input, r.file.output,
                           r.lost() ? fmt::format(" ({} lost)", r.lost()) : "");
            return;
        }
        auto error = std::ranges::find(r.findings, "error", &ReportedFinding::severity);
        fmt::print(
            stderr, "kinora: error: '{}' {} {}: {}\n", r.file.input,
            r.outcome == Outcome::Failed ? "failed with exit" : "crashed with signal", r.code,
            error != r.findings.end() ? error->message : r.said.substr(0, r.said.find('\n')));
    }

    int finish() {
        size_t failed = 0, kept = 0, tried = 0, lossy = 0;
        for (const FileRecord& r : records_) {
            failed += r.outcome == Outcome::Failed || r.outcome == Outcome::Crashed;
            tried += r.outcome != Outcome::NotTried;
            kept += r.kept;
            lossy += r.outcome == Outcome::Converted && r.lost() > 0;
        }
        if (!options_.findings.quiet)
            fmt::print(stderr, "{} of {} files: {} failed, {} with losses, {} kept from before\n",
                       tried, records_.size(), failed, lossy, kept);
        if (!options_.report.empty())
            if (int code = write_whole(options_.report, folder_report(options_, records_)))
                return code;
        if (stopped_by) return 128 + stopped_by;
        return failed ? kExitSomeFailed : kExitOk;
    }

    ConvertOptions options_;
    std::vector<FolderFile> files_;
    std::vector<FileRecord> records_;  // of each file
    FolderJournal journal_;
    std::map<pid_t, std::pair<size_t, ConversionProcess>> running_;
};

}  // namespace

int convert_folder(const ConvertOptions& options) {
    return FolderConversion(options).run();
}

}  // namespace kinora
