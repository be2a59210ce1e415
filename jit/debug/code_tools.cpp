// jit/debug/code_tools.cpp: perf's map file and GDB's JIT interface; jit_dump.cpp has the other
// file.
#include "jit/debug/code_tools.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <mutex>

#include "jit/debug/jit_dump_p.h"

// The interface that GDB looks for by name: "JIT Compilation Interface" in its manual.
extern "C" {

struct jit_code_entry {
    jit_code_entry* next_entry;
    jit_code_entry* prev_entry;
    const char* symfile_addr;
    uint64_t symfile_size;
};
struct jit_descriptor {
    uint32_t version;
    uint32_t action_flag;
    jit_code_entry* relevant_entry;
    jit_code_entry* first_entry;
};

// GDB stops here and reads the descriptor.
[[gnu::noinline]] void __jit_debug_register_code();
void __jit_debug_register_code() {
    asm volatile("" ::: "memory");
}
extern jit_descriptor __jit_debug_descriptor;
jit_descriptor __jit_debug_descriptor = {1, 0, nullptr, nullptr};
}

namespace kinora::jit {

namespace {

enum Action : uint32_t { kRegister = 1, kUnregister = 2 };

bool is_on(const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && *value != 0 && *value != '0';
}

std::mutex& registry_mutex() {
    static std::mutex mutex;
    return mutex;
}

// An object file in GDB's list for as long as this lives.
class Registration {
  public:
    explicit Registration(std::vector<std::byte> object) : object_(std::move(object)) {
        entry_.symfile_addr = reinterpret_cast<const char*>(object_.data());
        entry_.symfile_size = object_.size();
        std::lock_guard lock(registry_mutex());
        entry_.prev_entry = nullptr;
        entry_.next_entry = __jit_debug_descriptor.first_entry;
        if (entry_.next_entry != nullptr) entry_.next_entry->prev_entry = &entry_;
        __jit_debug_descriptor.first_entry = &entry_;
        tell(kRegister);
    }
    ~Registration() {
        std::lock_guard lock(registry_mutex());
        jit_code_entry*& before = entry_.prev_entry != nullptr ? entry_.prev_entry->next_entry
                                                               : __jit_debug_descriptor.first_entry;
        before = entry_.next_entry;
        if (entry_.next_entry != nullptr) entry_.next_entry->prev_entry = entry_.prev_entry;
        tell(kUnregister);
    }
    Registration(const Registration&) = delete;
    Registration& operator=(const Registration&) = delete;

  private:
    void tell(Action action) {
        __jit_debug_descriptor.relevant_entry = &entry_;
        __jit_debug_descriptor.action_flag = action;
        __jit_debug_register_code();
        __jit_debug_descriptor.action_flag = 0;
    }

    std::vector<std::byte> object_;
    jit_code_entry entry_ = {};
};

// "START SIZE NAME" in hexadecimal, a line each: tools/perf/Documentation/jit-interface.txt.
void add_to_perf_map(const Kernel& kernel) {
    static std::mutex mutex;
    std::lock_guard lock(mutex);
    std::FILE* file = std::fopen(fmt::format("/tmp/perf-{}.map", getpid()).c_str(), "a");
    if (file == nullptr) return;
    fmt::print(file, "{:x} {:x} {}\n", reinterpret_cast<uintptr_t>(kernel.machine_code.data()),
               kernel.machine_code.size(), code_symbol(kernel));
    std::fclose(file);
}

}  // namespace

std::string code_symbol(const Kernel& kernel) {
    std::string name = fmt::format("kinora_{}_{}", kernel.name, kernel.target);
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

void show_code(Kernel& kernel, const SourceFiles* files) {
    static const bool perf = is_on("KINORA_PERF"), gdb = is_on("KINORA_GDB");
    static const char* const dump = std::getenv("KINORA_JITDUMP");
    if (kernel.machine_code.empty()) return;
    if (dump != nullptr && *dump != 0) add_to_jit_dump(dump, kernel, files);
    if (perf) add_to_perf_map(kernel);
    if (gdb) kernel.shown = std::make_shared<Registration>(debug_object(kernel, files));
}

}  // namespace kinora::jit
