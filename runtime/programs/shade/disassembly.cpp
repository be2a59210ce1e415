// runtime/programs/shade/disassembly.cpp: machine code of a kernel beside the shader's lines, by
// Capstone.
#include "runtime/programs/shade/disassembly.h"

#include <capstone/capstone.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <type_traits>

namespace kinora {

namespace {

struct Machine {
    std::string_view target;
    cs_arch arch;
    cs_mode mode;
};
constexpr Machine kMachines[] = {{"avx2", CS_ARCH_X86, CS_MODE_64},
                                 {"avx512", CS_ARCH_X86, CS_MODE_64},
                                 {"neon", CS_ARCH_ARM64, CS_MODE_LITTLE_ENDIAN}};

// Capstone's functions, or why there are none. It is loaded on demand: its tables are two thirds of
// what the dynamic linker relocates at a start of this program.
struct Capstone {
    decltype(&cs_open) open = nullptr;
    decltype(&cs_option) option = nullptr;
    decltype(&cs_disasm) disassemble = nullptr;
    decltype(&cs_free) free = nullptr;
    decltype(&cs_close) close = nullptr;
    std::string error;
};

Capstone load_capstone() {
    Capstone capstone;
    const std::string name = fmt::format("libcapstone.so.{}", CS_API_MAJOR);
    void* library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    bool found = library != nullptr;
    auto find = [&](auto& function, const char* symbol) {
        if (!found) return;
        function = reinterpret_cast<std::decay_t<decltype(function)>>(dlsym(library, symbol));
        found = function != nullptr;
    };
    find(capstone.open, "cs_open");
    find(capstone.option, "cs_option");
    find(capstone.disassemble, "cs_disasm");
    find(capstone.free, "cs_free");
    find(capstone.close, "cs_close");
    if (found) return capstone;
    const char* why = dlerror();
    capstone.error = fmt::format(
        "machine code is listed by {}, which cannot be loaded ({}); install "
        "it, or dump another stage",
        name, why ? why : "it lacks a function");
    return capstone;
}

const Capstone& capstone() {
    static const Capstone loaded = load_capstone();
    return loaded;
}

class Disassembler {
  public:
    explicit Disassembler(const Machine& machine) {
        open_ = capstone().open(machine.arch, machine.mode, &handle_) == CS_ERR_OK;
        if (open_) capstone().option(handle_, CS_OPT_SKIPDATA, CS_OPT_ON);  // what it does not know
    }
    ~Disassembler() {
        if (open_) capstone().close(&handle_);
    }
    Disassembler(const Disassembler&) = delete;
    Disassembler& operator=(const Disassembler&) = delete;

    void append(std::span<const std::byte> code, size_t offset, std::string& text) const {
        cs_insn* list = nullptr;
        size_t count = capstone().disassemble(
            handle_, reinterpret_cast<const uint8_t*>(code.data()), code.size(), offset, 0, &list);
        for (size_t k = 0; k < count; ++k)
            fmt::format_to(std::back_inserter(text), "  {:04x}  {} {}\n", list[k].address,
                           list[k].mnemonic, list[k].op_str);
        if (count > 0) capstone().free(list, count);
    }
    bool is_open() const { return open_; }

  private:
    csh handle_ = 0;
    bool open_ = false;
};

std::string_view trimmed(std::string_view line) {
    size_t begin = line.find_first_not_of(" \t");
    return begin == std::string_view::npos ? "" : line.substr(begin);
}

std::string heading(const Location& where, const SourceFiles& files) {
    if (where.file == kNoFile || where.file >= files.count()) return "; no line\n";
    int line = files.line_column(where.file, where.begin).line;
    return fmt::format("; {}:{}: {}\n", files.name(where.file), line,
                       trimmed(files.line_text(where.file, line)));
}

}  // namespace

std::string disassembly(const jit::Kernel& kernel, const SourceFiles& files, std::string& error) {
    const Machine* machine = nullptr;
    for (const Machine& row : kMachines)
        if (row.target == kernel.target) machine = &row;
    if (machine == nullptr || kernel.lines.empty()) return "";
    error = capstone().error;
    if (!error.empty()) return "";
    Disassembler disassembler(*machine);
    if (!disassembler.is_open()) return "";
    std::string text, last;
    size_t at = 0;
    Location where;
    for (const jit::CodeLine& next : kernel.lines) {
        std::string title = heading(where, files);
        if (next.offset > at && title != last) text += last = title;
        disassembler.append(kernel.machine_code.subspan(at, next.offset - at), at, text);
        at = next.offset;
        where = next.where;
    }
    return text + fmt::format("; {} bytes of constants\n", kernel.machine_code.size() - at);
}

}  // namespace kinora
