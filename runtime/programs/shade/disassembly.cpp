// runtime/programs/shade/disassembly.cpp: machine code of a kernel beside the shader's lines, by
// Capstone.
#include "runtime/programs/shade/disassembly.h"

#include <capstone/capstone.h>
#include <fmt/format.h>

#include <string_view>

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

class Disassembler {
  public:
    explicit Disassembler(const Machine& machine) {
        open_ = cs_open(machine.arch, machine.mode, &handle_) == CS_ERR_OK;
        if (open_) cs_option(handle_, CS_OPT_SKIPDATA, CS_OPT_ON);  // what it does not know
    }
    ~Disassembler() {
        if (open_) cs_close(&handle_);
    }
    Disassembler(const Disassembler&) = delete;
    Disassembler& operator=(const Disassembler&) = delete;

    void append(std::span<const std::byte> code, size_t offset, std::string& text) const {
        cs_insn* list = nullptr;
        size_t count = cs_disasm(handle_, reinterpret_cast<const uint8_t*>(code.data()),
                                 code.size(), offset, 0, &list);
        for (size_t k = 0; k < count; ++k)
            fmt::format_to(std::back_inserter(text), "  {:04x}  {} {}\n", list[k].address,
                           list[k].mnemonic, list[k].op_str);
        if (count > 0) cs_free(list, count);
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

std::string disassembly(const jit::Kernel& kernel, const SourceFiles& files) {
    const Machine* machine = nullptr;
    for (const Machine& row : kMachines)
        if (row.target == kernel.target) machine = &row;
    if (machine == nullptr || kernel.lines.empty()) return "";
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
