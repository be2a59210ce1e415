// jit/ir/print.cpp: the IR as text, one instruction a line. parse.cpp reads it back.
//
//   module "marble" budget 1000000 slots 0
//   table 0.5 0.25 1 1 1 1 1 1
//   input "P.x" f point du "dPdu.x" dv "dPdv.x"
//   output "Ci.r" f
//   service "texture" (i f f) -> (f f f) pure
//   fault "a loop ran too long"
//   function "kernel" () -> (f)
//     array "tmp" f 10
//     %0 = constf 1.5
//     %1 = input.f #0
//     if %7
//       %9 = fma %0, %1, %8
//     endif #8
//     return [%9]
//   end
#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <iterator>

#include "jit/ir/ir.h"
#include "jit/ir/type_name_p.h"

namespace kinora::jit {

namespace {

constexpr const char* kRateNames[] = {"constant", "frame", "point"};

std::string lower(const char* name) {
    std::string out;
    for (; *name != 0; ++name)
        out += static_cast<char>(std::tolower(static_cast<unsigned char>(*name)));
    return out;
}

std::string in_quotes(std::string_view text) {
    std::string out = "\"";
    for (char c : text) {
        if (c == '\n') {
            out += "\\n";
            continue;
        }
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + '"';
}

std::string types_text(const std::vector<Type>& types) {
    std::string out = "(";
    for (Type type : types) out += (out.size() > 1 ? " " : "") + std::string(type_name(type));
    return out + ")";
}

// Shortest decimal that reads back to the same float; bits where decimals do not tell.
std::string float_text(float value) {
    if (!std::isfinite(value))
        return fmt::format("0x{:08x}", static_cast<uint32_t>(bits_of(value)));
    return fmt::format("{}", value);
}

using Out = std::back_insert_iterator<std::string>;

void print_inst(Out out, const Function& f, Value v) {
    const Inst& inst = f.insts[v];
    const OpInfo& info = op_info(inst.op);
    if (inst.type != Type::None) fmt::format_to(out, "%{} = ", v);
    fmt::format_to(out, "{}", lower(info.name));
    if (info.result == 'T') fmt::format_to(out, ".{}", type_name(inst.type));
    const char* gap = " ";
    auto item = [&](const std::string& text) {
        fmt::format_to(out, "{}{}", gap, text);
        gap = ", ";
    };
    if (inst.op == Op::ConstF) return item(float_text(float_of(inst.imm)));
    for (Value operand : {inst.a, inst.b, inst.c})
        if (operand != kNone) item(fmt::format("%{}", operand));
    if (inst.imm != 0 || inst.imm2 != 0) item(fmt::format("#{}", inst.imm));
    if (inst.imm2 != 0) item(fmt::format("#{}", inst.imm2));
    if (inst.arg_count == 0) return;
    std::string list;
    for (Value arg : f.args_of(inst)) list += fmt::format("{}%{}", list.empty() ? "" : " ", arg);
    item("[" + list + "]");
}

void print_function(Out out, const Function& f) {
    fmt::format_to(out, "function {} {} -> {}\n", in_quotes(f.name), types_text(f.params),
                   types_text(f.results));
    for (const ArrayInfo& array : f.arrays)
        fmt::format_to(
            out, "  array {} {} {}{}\n", in_quotes(array.name), type_name(array.type), array.length,
            array.cleared < array.length ? fmt::format(" cleared {}", array.cleared) : "");
    size_t depth = 1;
    for (Value v = 0; v < f.insts.size(); ++v) {
        Op op = f.insts[v].op;
        if ((op == Op::EndIf || op == Op::EndLoop) && depth > 1) --depth;
        fmt::format_to(out, "{:{}}", "", depth * 2);
        print_inst(out, f, v);
        fmt::format_to(out, "\n");
        if (op == Op::If || op == Op::Loop) ++depth;
    }
    fmt::format_to(out, "end\n");
}

}  // namespace

std::string print(const Module&, const Function& function) {
    std::string text;
    print_function(std::back_inserter(text), function);
    return text;
}

std::string print(const Module& module) {
    std::string text;
    Out out = std::back_inserter(text);
    fmt::format_to(out, "module {} budget {} slots {}", in_quotes(module.name), module.loop_budget,
                   module.frame_slots);
    if (module.call_depth != 0) fmt::format_to(out, " depth {}", module.call_depth);
    fmt::format_to(out, "\n");
    if (!module.table.empty()) {
        fmt::format_to(out, "table");
        for (float value : module.table) fmt::format_to(out, " {}", float_text(value));
        fmt::format_to(out, "\n");
    }
    for (const InputInfo& input : module.inputs) {
        fmt::format_to(out, "input {} {} {}", in_quotes(input.name), type_name(input.type),
                       kRateNames[static_cast<int>(input.rate)]);
        if (!input.du.empty()) fmt::format_to(out, " du {}", in_quotes(input.du));
        if (!input.dv.empty()) fmt::format_to(out, " dv {}", in_quotes(input.dv));
        fmt::format_to(out, "\n");
    }
    for (const OutputInfo& output : module.outputs)
        fmt::format_to(out, "output {} {}\n", in_quotes(output.name), type_name(output.type));
    for (const ServiceInfo& service : module.services)
        fmt::format_to(out, "service {} {} -> {}{}\n", in_quotes(service.name),
                       types_text(service.params), types_text(service.results),
                       service.pure ? " pure" : "");
    for (const FaultSite& site : module.fault_sites)
        fmt::format_to(out, "fault {}\n", in_quotes(site.message));
    for (const Function& function : module.functions) print_function(out, function);
    return text;
}

}  // namespace kinora::jit
