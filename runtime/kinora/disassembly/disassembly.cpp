// runtime/kinora/disassembly/disassembly.cpp: machine code of a kernel beside the shader's lines,
// by Capstone.
#include "runtime/kinora/disassembly/disassembly.h"

#include <capstone/capstone.h>
#include <fmt/format.h>

#include <string>
#include <string_view>

#include "runtime/base/shared_library.h"

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

// Capstone's functions, or why there are none. Its tables are large: it is opened when needed.
struct Capstone : SharedLibrary {
    Capstone()
        : SharedLibrary(KINORA_CAPSTONE_LIBRARY, "machine code is listed",
                        "libcapstone4, or dump another stage") {}

    KINORA_FUNCTION(cs_open);
    KINORA_FUNCTION(cs_option);
    KINORA_FUNCTION(cs_disasm);
    KINORA_FUNCTION(cs_free);
    KINORA_FUNCTION(cs_close);
};

const Capstone& capstone() {
    return opened<Capstone>();
}

class Disassembler {
  public:
    explicit Disassembler(const Machine& machine) {
        open_ = capstone().cs_open(machine.arch, machine.mode, &handle_) == CS_ERR_OK;
        if (open_)
            capstone().cs_option(handle_, CS_OPT_SKIPDATA, CS_OPT_ON);  // what it does not know
    }
    ~Disassembler() {
        if (open_) capstone().cs_close(&handle_);
    }
    Disassembler(const Disassembler&) = delete;
    Disassembler& operator=(const Disassembler&) = delete;

    void append(std::span<const std::byte> code, size_t offset,
                std::vector<std::string>& lines) const {
        cs_insn* list = nullptr;
        size_t count = capstone().cs_disasm(handle_, reinterpret_cast<const uint8_t*>(code.data()),
                                            code.size(), offset, 0, &list);
        for (size_t k = 0; k < count; ++k)
            lines.push_back(
                fmt::format("{:04x}  {} {}", list[k].address, list[k].mnemonic, list[k].op_str));
        if (count > 0) capstone().cs_free(list, count);
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

MachineRun run_at(const Location& where, const SourceFiles& files) {
    MachineRun run;
    if (where.file == kNoFile || where.file >= files.count()) return run;
    run.file = files.name(where.file);
    run.line = files.line_column(where.file, where.begin).line;
    run.source = std::string(trimmed(files.line_text(where.file, run.line)));
    return run;
}

const Machine* machine_of(const jit::Kernel& kernel) {
    for (const Machine& row : kMachines)
        if (row.target == kernel.target) return kernel.lines.empty() ? nullptr : &row;
    return nullptr;
}

}  // namespace

std::vector<MachineRun> machine_runs(const jit::Kernel& kernel, const SourceFiles& files,
                                     std::string& error) {
    const Machine* machine = machine_of(kernel);
    if (machine == nullptr) return {};
    error = capstone().error();
    if (!error.empty()) return {};
    Disassembler disassembler(*machine);
    if (!disassembler.is_open()) return {};
    std::vector<MachineRun> runs;
    size_t at = 0;
    Location where;
    for (const jit::CodeLine& next : kernel.lines) {
        if (next.offset > at) {
            MachineRun run = run_at(where, files);
            if (runs.empty() || runs.back().file != run.file || runs.back().line != run.line)
                runs.push_back(std::move(run));
            disassembler.append(kernel.machine_code.subspan(at, next.offset - at), at,
                                runs.back().instructions);
        }
        at = next.offset;
        where = next.where;
    }
    return runs;
}

std::string disassembly(const jit::Kernel& kernel, const SourceFiles& files, std::string& error) {
    const std::vector<MachineRun> runs = machine_runs(kernel, files, error);
    if (runs.empty()) return "";
    std::string text;
    for (const MachineRun& run : runs) {
        text += run.file.empty() ? "; no line\n"
                                 : fmt::format("; {}:{}: {}\n", run.file, run.line, run.source);
        for (const std::string& instruction : run.instructions)
            text += fmt::format("  {}\n", instruction);
    }
    return text + fmt::format("; {} bytes of constants\n",
                              kernel.machine_code.size() - kernel.lines.back().offset);
}

}  // namespace kinora
