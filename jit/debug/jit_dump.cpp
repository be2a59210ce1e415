// jit/debug/jit_dump.cpp: kernels in the file that `perf inject --jit` reads (version 1 of the
// format; Linux, tools/perf/Documentation/jitdump-specification.txt).
#include "jit/debug/jit_dump_p.h"

#include <elf.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <type_traits>

#include "jit/debug/code_tools.h"

namespace kinora::jit {

namespace {

enum RecordId : uint32_t { kCodeLoad = 0, kDebugInfo = 2 };
constexpr uint32_t kMagic = 0x4a695444, kVersion = 1, kHeaderBytes = 40;
#if defined(__aarch64__)
constexpr uint32_t kMachine = EM_AARCH64;
#else
constexpr uint32_t kMachine = EM_X86_64;
#endif

// perf record -k 1 writes the same clock.
uint64_t nanoseconds() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<uint64_t>(now.tv_sec) * 1'000'000'000 + static_cast<uint64_t>(now.tv_nsec);
}

template <class T>
void put(std::string& bytes, T value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string record(RecordId id, const std::string& body) {
    std::string bytes;
    put<uint32_t>(bytes, id);
    put(bytes, static_cast<uint32_t>(16 + body.size()));
    put(bytes, nanoseconds());
    return bytes + body;
}

// Stands before the code that it is about.
std::string lines(const Kernel& kernel, const SourceFiles& files) {
    std::string rows;
    uint64_t count = 0;
    for (const CodeLine& line : kernel.lines) {
        if (line.where.file >= files.count()) continue;
        LineColumn at = files.line_column(line.where.file, line.where.begin);
        put(rows, address_of(kernel) + line.offset);
        put(rows, static_cast<uint32_t>(at.line));
        put(rows, static_cast<uint32_t>(at.column));
        rows += files.name(line.where.file);
        rows += '\0';
        ++count;
    }
    std::string body;
    put(body, address_of(kernel));
    put(body, count);
    return record(kDebugInfo, body + rows);
}

std::string code(const Kernel& kernel, uint64_t index) {
    std::string body;
    put(body, static_cast<uint32_t>(getpid()));
    put(body, static_cast<uint32_t>(syscall(SYS_gettid)));
    put(body, address_of(kernel));  // where it runs is where it was made
    put(body, address_of(kernel));
    put(body, static_cast<uint64_t>(kernel.machine_code.size()));
    put(body, index);
    body += code_symbol(kernel);
    body += '\0';
    body.append(reinterpret_cast<const char*>(kernel.machine_code.data()),
                kernel.machine_code.size());
    return record(kCodeLoad, body);
}

class DumpFile {
  public:
    explicit DumpFile(const std::string& folder)
        : name_(fmt::format("{}/jit-{}.dump", folder, getpid())),
          file_(open(name_.c_str(), O_CREAT | O_TRUNC | O_RDWR | O_CLOEXEC, 0666)) {
        if (file_ < 0) complain();
        std::string head;
        for (uint32_t word :
             {kMagic, kVersion, kHeaderBytes, kMachine, 0u, static_cast<uint32_t>(getpid())})
            put(head, word);
        put(head, nanoseconds());
        put<uint64_t>(head, 0);  // no flags
        write(head);
        // perf finds the file by this mapping; it lasts as long as the process.
        auto page = static_cast<size_t>(sysconf(_SC_PAGESIZE));
        if (file_ >= 0) mmap(nullptr, page, PROT_READ | PROT_EXEC, MAP_PRIVATE, file_, 0);
    }

    void add(const Kernel& kernel, const SourceFiles* files) {
        std::lock_guard lock(mutex_);
        std::string rows;
        if (files != nullptr) rows = lines(kernel, *files);
        write(rows + code(kernel, index_++));
    }

  private:
    void write(const std::string& bytes) {
        if (file_ < 0 || ::write(file_, bytes.data(), bytes.size()) >= 0) return;
        complain();
        file_ = -1;
    }

    // Who asks for the file is at the terminal.
    void complain() const {
        fmt::print(stderr, "KINORA_JITDUMP: cannot write '{}': {}\n", name_, strerror(errno));
    }

    std::string name_;
    int file_;
    uint64_t index_ = 0;
    std::mutex mutex_;
};

}  // namespace

void add_to_jit_dump(const std::string& folder, const Kernel& kernel, const SourceFiles* files) {
    static auto* file = new DumpFile(folder);  // threads may still compile while statics end
    file->add(kernel, files);
}

}  // namespace kinora::jit
