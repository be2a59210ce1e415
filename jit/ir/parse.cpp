// jit/ir/parse.cpp: reads the text that print.cpp writes.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <unordered_map>

#include "jit/ir/findings.h"
#include "jit/ir/ir.h"

namespace kinora::jit {

namespace {

std::string lower(std::string_view name) {
    std::string out;
    for (char c : name) out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

const std::unordered_map<std::string, Op>& ops_by_name() {
    static const auto table = [] {
        std::unordered_map<std::string, Op> map;
        for (size_t k = 0; k < static_cast<size_t>(Op::Count); ++k)
            map[lower(kOps[k].name)] = static_cast<Op>(k);
        return map;
    }();
    return table;
}

class Parser {
  public:
    Parser(std::string_view text, FileId file, Diagnostics& diagnostics)
        : text_(text), file_(file), diagnostics_(diagnostics) {}

    Module parse() {
        while (ok_ && skip_lines()) parse_declaration();
        if (ok_) check();
        return ok_ ? std::move(m_) : Module{};
    }

  private:
    template <class... Args>
    bool fail(const FindingInfo& info, const Args&... args) {
        if (ok_) {
            auto at = static_cast<uint32_t>(token_);
            diagnostics_.report(info, {file_, at, static_cast<uint32_t>(at_)}, args...);
        }
        ok_ = false;
        return false;
    }

    void check() {
        std::string error = verify(m_);
        token_ = at_ = text_.size();
        if (!error.empty()) fail(Code::IR_BAD_MODULE, error);
    }

    // Characters.

    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    void skip_spaces() {
        while (peek() == ' ' || peek() == '\t' || peek() == '\r' || peek() == ',') ++at_;
        if (peek() == ';')
            while (at_ < text_.size() && text_[at_] != '\n') ++at_;
        token_ = at_;
    }
    // To the first character of the next line that says something.
    bool skip_lines() {
        for (skip_spaces(); peek() == '\n'; skip_spaces()) ++at_;
        return at_ < text_.size();
    }
    bool line_ended() {
        skip_spaces();
        return peek() == '\n' || at_ >= text_.size();
    }
    bool accept(std::string_view mark) {
        skip_spaces();
        if (text_.substr(at_, mark.size()) != mark) return false;
        at_ += mark.size();
        return true;
    }
    bool expect(std::string_view mark) {
        return accept(mark) || fail(Code::IR_SYNTAX, std::string("'") + std::string(mark) + "'");
    }

    std::string_view word() {
        skip_spaces();
        while (std::isalnum(static_cast<unsigned char>(peek())) || peek() == '_') ++at_;
        return text_.substr(token_, at_ - token_);
    }

    std::string string() {
        std::string out;
        if (!expect("\"")) return out;
        while (at_ < text_.size() && peek() != '"' && peek() != '\n') {
            bool escaped = peek() == '\\';
            if (escaped) ++at_;
            out += escaped && peek() == 'n' ? '\n' : peek();
            ++at_;
        }
        if (peek() != '"')
            fail(Code::IR_SYNTAX, "'\"'");
        else
            ++at_;
        return out;
    }

    template <class T>
    T number() {
        skip_spaces();
        T value = 0;
        const char* begin = text_.data() + at_;
        auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
        if (error != std::errc{}) fail(Code::IR_SYNTAX, "a number");
        at_ += static_cast<size_t>(end - begin);
        return value;
    }

    // "1.5", or bits as "0x7fc00000".
    int32_t float_bits() {
        skip_spaces();
        if (!accept("0x")) return bits_of(number<float>());
        uint32_t bits = 0;
        const char* begin = text_.data() + at_;
        auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), bits, 16);
        if (error != std::errc{}) fail(Code::IR_SYNTAX, "hexadecimal digits");
        at_ += static_cast<size_t>(end - begin);
        return static_cast<int32_t>(bits);
    }

    template <class T, size_t N>
    T named(const char* kind, const char* const (&names)[N]) {
        std::string_view name = word();
        for (size_t k = 0; k < N; ++k)
            if (name == names[k]) return static_cast<T>(k);
        fail(Code::IR_UNKNOWN_NAME, kind, name);
        return T{};
    }
    Type type() {
        constexpr const char* kTypes[] = {"none", "f", "i", "m"};
        return named<Type>("type", kTypes);
    }
    std::vector<Type> types() {
        std::vector<Type> list;
        if (!expect("(")) return list;
        while (ok_ && !accept(")")) list.push_back(type());
        return list;
    }

    // Declarations.

    void parse_declaration() {
        std::string_view kind = word();
        if (kind == "module") return parse_head();
        if (kind == "table") return parse_table();
        if (kind == "input") return parse_input();
        if (kind == "output") {
            std::string name = string();
            return m_.outputs.push_back({std::move(name), type()});
        }
        if (kind == "service") return parse_service();
        if (kind == "fault") return m_.fault_sites.push_back({{}, string()});
        if (kind == "function") return parse_function();
        fail(Code::IR_UNKNOWN_NAME, "declaration", kind);
    }

    void parse_head() {
        m_.name = string();
        if (expect("budget")) m_.loop_budget = number<int32_t>();
        if (expect("slots")) m_.frame_slots = number<int32_t>();
        if (accept("depth")) m_.call_depth = number<int32_t>();
    }

    void parse_table() {
        while (ok_ && !line_ended()) m_.table.push_back(float_of(float_bits()));
    }

    void parse_input() {
        constexpr const char* kRates[] = {"constant", "frame", "point"};
        InputInfo input;
        input.name = string();
        input.type = type();
        input.rate = named<Rate>("rate", kRates);
        if (accept("du")) input.du = string();
        if (accept("dv")) input.dv = string();
        m_.inputs.push_back(std::move(input));
    }

    void parse_service() {
        ServiceInfo service;
        service.name = string();
        service.params = types();
        expect("->");
        service.results = types();
        service.pure = accept("pure");
        m_.services.push_back(std::move(service));
    }

    void parse_function() {
        Function& f = m_.functions.emplace_back();
        f.name = string();
        f.params = types();
        expect("->");
        f.results = types();
        while (ok_ && skip_lines()) {
            size_t line = at_;
            if (word() == "end" && line_ended()) return;
            at_ = token_ = line;
            parse_line(f);
            if (ok_ && !line_ended()) fail(Code::IR_SYNTAX, "the end of the line");
        }
        fail(Code::IR_SYNTAX, "'end'");
    }

    void parse_line(Function& f) {
        if (accept("array ")) {
            ArrayInfo array{};
            array.name = string();
            array.type = type();
            array.length = array.cleared = number<int32_t>();
            if (accept(" cleared "))
                array.cleared = std::clamp(number<int32_t>(), 0, std::max(array.length, 0));
            return f.arrays.push_back(std::move(array));
        }
        bool named_value = accept("%");
        if (named_value) {
            if (number<Value>() != f.insts.size())
                fail(Code::IR_SYNTAX, "%" + std::to_string(f.insts.size()));
            expect("=");
        }
        Inst inst = parse_inst(f);
        if (ok_ && named_value != (inst.type != Type::None))
            fail(Code::IR_SYNTAX, named_value ? "an op with a value" : "'%'");
        f.insts.push_back(inst);
    }

    Inst parse_inst(Function& f) {
        std::string_view name = word();
        auto at = ops_by_name().find(std::string(name));
        if (at == ops_by_name().end()) return fail(Code::IR_UNKNOWN_NAME, "op", name), Inst{};
        Inst inst{.op = at->second};
        const OpInfo& info = op_info(inst.op);
        inst.type = type_of_letter(info.result);
        if (info.result == 'T' && expect(".")) inst.type = type();
        if (inst.op == Op::ConstF)
            inst.imm = float_bits();
        else
            parse_operands(f, inst);
        return inst;
    }

    void parse_operands(Function& f, Inst& inst) {
        Value* operands[] = {&inst.a, &inst.b, &inst.c};
        int32_t* immediates[] = {&inst.imm, &inst.imm2};
        size_t operand = 0, immediate = 0;
        while (ok_ && !line_ended()) {
            if (operand < 3 && accept("%"))
                *operands[operand++] = number<Value>();
            else if (immediate < 2 && accept("#"))
                *immediates[immediate++] = number<int32_t>();
            else if (expect("["))
                parse_args(f, inst);
        }
    }

    void parse_args(Function& f, Inst& inst) {
        inst.args = static_cast<uint32_t>(f.args.size());
        while (ok_ && !accept("]")) {
            if (expect("%")) f.args.push_back(number<Value>());
            ++inst.arg_count;
        }
    }

    std::string_view text_;
    FileId file_;
    Diagnostics& diagnostics_;
    Module m_;
    size_t at_ = 0;
    size_t token_ = 0;
    bool ok_ = true;
};

}  // namespace

Module parse_module(std::string_view text, std::string_view name, Diagnostics& diagnostics) {
    FileId file = diagnostics.files.add(std::string(name), std::string(text));
    return Parser(diagnostics.files.text(file), file, diagnostics).parse();
}

}  // namespace kinora::jit
