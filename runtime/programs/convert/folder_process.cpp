// runtime/programs/convert/folder_process.cpp: the conversion of one file in a process of its own.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/convert/folder_p.h"

namespace kinora {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMostSaid = 4096;

std::string content(int file, size_t most) {
    std::string text;
    char bytes[65536];
    lseek(file, 0, SEEK_SET);
    for (ssize_t n; text.size() < most && (n = read(file, bytes, sizeof bytes)) > 0;)
        text.append(bytes, size_t(n));
    text.resize(std::min(text.size(), most));
    return text;
}

void write_all(int file, const std::string& text) {
    for (size_t at = 0; at < text.size();) {
        ssize_t n = write(file, text.data() + at, text.size() - at);
        if (n <= 0) return;
        at += size_t(n);
    }
}

// In the new process.
[[noreturn]] void run(const ConvertOptions& options, int findings, int said) {
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    dup2(said, STDERR_FILENO);
    dup2(said, STDOUT_FILENO);
    Diagnostics diagnostics;
    int code = convert(options, diagnostics);
    write_all(findings, findings_text(diagnostics));
    std::fflush(nullptr);
    _exit(code);
}

}  // namespace

// No thread runs in this process, so that a fork is a whole copy of it.
bool ConversionProcess::start(const ConvertOptions& options, const FolderFile& file) {
    file_ = file;
    ConvertOptions own = options;
    own.input = (fs::path(options.input) / file.input).string();
    own.output = output_ = (fs::path(options.output) / file.output).string();
    own.findings.silent = true;
    own.stats = own.stats_json = false;
    findings_ = memfd_create("findings", MFD_CLOEXEC);
    said_ = memfd_create("said", MFD_CLOEXEC);
    if (findings_ < 0 || said_ < 0) return false;
    std::fflush(nullptr);
    pid_ = fork();
    if (pid_ == 0) run(own, findings_, said_);
    return pid_ > 0;
}

FileRecord ConversionProcess::finish(int status) const {
    FileRecord record;
    record.file = file_;
    record.findings = parse_findings(content(findings_, size_t(1) << 26));
    record.said = content(said_, kMostSaid);
    while (!record.said.empty() && record.said.back() == '\n') record.said.pop_back();
    close(findings_);
    close(said_);
    if (WIFSIGNALED(status)) {
        record.outcome = Outcome::Crashed;
        record.code = WTERMSIG(status);
        return record;
    }
    record.code = WEXITSTATUS(status);
    // Exit 1 without an output is an error; with one it is what --strict and --fail-on call so.
    record.outcome = record.code == kExitOk ? Outcome::Converted : Outcome::Failed;
    std::error_code code;
    record.bytes = record.outcome == Outcome::Converted ? fs::file_size(output_, code) : 0;
    return record;
}

}  // namespace kinora
