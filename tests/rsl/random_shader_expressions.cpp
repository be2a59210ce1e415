// tests/rsl/random_shader_expressions.cpp: expressions of a wanted type at random. Every call
// states its type, so that no overload is chosen by the surroundings.
#include "tests/rsl/shader_writer_p.h"

namespace kinora::rsl {

namespace {

// Strings that rows give a meaning to; all others take names of spaces (or any name).
struct Vocabulary {
    std::string_view row;
    std::vector<const char*> words;
};
const Vocabulary kVocabulary[] = {
    {"ctransform", {"hsv", "hsl", "rgb", "YIQ"}},
    {"spline", {"bspline", "catmull-rom", "linear"}},
    {"match", {"w", "^o", "orl", "d$"}},
};
// Rows that are defined for directions of length 1 only.
constexpr std::string_view kUnitRows[] = {"fresnel", "refract"};
constexpr const char* kSpaces[] = {"world", "object", "shader", "current", "camera"};
constexpr const char* kColorSpaces[] = {"hsv", "hsl", "YIQ"};

char conversion_of(BaseType type) {
    return type == BaseType::Float    ? 'f'
           : type == BaseType::Color  ? 'c'
           : type == BaseType::String ? 's'
           : type == BaseType::Matrix ? 'm'
                                      : 'p';
}

BaseType global_base(const GlobalInfo& g) {
    return g.type.base;
}

}  // namespace

BaseType ShaderWriter::value_type() {
    constexpr BaseType kTypes[] = {BaseType::Float,  BaseType::Float,  BaseType::Float,
                                   BaseType::Float,  BaseType::Float,  BaseType::Color,
                                   BaseType::Color,  BaseType::Point,  BaseType::Vector,
                                   BaseType::Normal, BaseType::Matrix, BaseType::String};
    return kTypes[below(int(std::size(kTypes)))];
}

std::string ShaderWriter::value(BaseType type, int depth) {
    if (depth <= 0 || chance(15)) return leaf(type);
    std::string text;
    int dice = below(100);
    if (dice < policy_.selects)
        text = select(type, depth);
    else if (dice < 45)
        text = row_call(type, depth);
    else if (dice < 52)
        text = user_call(type, depth);
    else if (dice < 62)
        text = element(type, depth);
    else if (dice < 72)
        text = composed(type, depth);
    else
        text = arithmetic(type, depth);
    return text.empty() ? leaf(type) : text;
}

// ---- without operands ---------------------------------------------------------------------------

std::string ShaderWriter::literal(BaseType type) {
    static const char* const kFloats[] = {"0", "1", "0.5", "2", "-1", "0.25", "3", "-0.75", "1e-3"};
    static const char* const kMatrices[] = {
        "matrix 1", "matrix 0.5",
        "matrix (1, 0.1, 0, 0, -0.2, 1.5, 0.3, 0, 0, 0.25, 0.75, 0, 0.5, -1, 2, 1)"};
    char number[32];
    switch (type) {
        case BaseType::String:
            return std::string("\"") + one_of(kSpaces) + "\"";
        case BaseType::Matrix:
            return one_of(kMatrices);
        case BaseType::Float:
            if (chance(50)) return one_of(kFloats);
            std::snprintf(number, sizeof number, "%.4g", double(random_.uniform(-2, 2)));
            return number;
        default:
            return std::string(type_name(type)) + " (" + literal(BaseType::Float) + ", " +
                   literal(BaseType::Float) + ", " + literal(BaseType::Float) + ")";
    }
}

std::string ShaderWriter::leaf(BaseType type) {
    if (chance(55))
        if (Variable* v = variable(type, false, false)) return read(*v);
    if (type == BaseType::String || type == BaseType::Matrix || chance(30)) return literal(type);
    std::vector<std::string_view> fits;
    for (const GlobalInfo& g : globals()) {
        bool of_light = g.name == "L" || g.name == "Cl" || g.name == "Ol";
        bool here = !of_light || in_illuminance_ || in_illuminate_;
        bool rate = !uniform_ || g.rate != Rate::Varying;
        if (global_base(g) == type && (g.readers & in_kind(kind_)) && here && rate)
            fits.push_back(g.name);
    }
    return fits.empty() ? literal(type) : std::string(fits[size_t(below(int(fits.size())))]);
}

// ---- operators ----------------------------------------------------------------------------------

std::string ShaderWriter::arithmetic(BaseType type, int depth) {
    static const char* const kOps[] = {" + ", " - ", " * ", " / ", " + ", " * "};
    if (type == BaseType::String) return "";
    if (type == BaseType::Matrix)
        return "(" + value(type, depth - 1) + (chance(70) ? " * " : " / ") +
               value(type, depth - 1) + ")";
    if (chance(10)) return "(- " + leaf(type) + ")";
    if (is_spatial(type)) return spatial(type, depth);
    if (type == BaseType::Float && chance(15))
        return "(" + value(BaseType::Vector, depth - 1) + " . " + leaf(BaseType::Normal) + ")";
    BaseType right = type == BaseType::Color && chance(40) ? BaseType::Float : type;
    return "(" + value(type, depth - 1) + one_of(kOps) + value(right, depth - 1) + ")";
}

// Points, vectors and normals mix; the cast says what the sum is.
std::string ShaderWriter::spatial(BaseType type, int depth) {
    constexpr BaseType kSpatial[] = {BaseType::Point, BaseType::Vector, BaseType::Normal};
    auto any = [&] { return value(kSpatial[below(3)], depth - 1); };
    std::string head = std::string(type_name(type)) + " (";
    switch (below(4)) {
        case 0:
            return head + any() + " + " + any() + ")";
        case 1:
            return head + any() + " - " + any() + ")";
        case 2:
            return head + any() + " ^ " + any() + ")";
        default:
            return head + any() + (chance(70) ? " * " : " / ") + value(BaseType::Float, depth - 1) +
                   ")";
    }
}

// From components, or from another space.
std::string ShaderWriter::composed(BaseType type, int depth) {
    auto f = [&] { return value(BaseType::Float, depth - 1); };
    if (type == BaseType::Matrix)
        return chance(50) ? std::string("matrix \"") + one_of(kSpaces) + "\" 1"
                          : "matrix (" + f() + ")";
    if (!is_triple(type)) return "";
    std::string space;
    if (chance(30))
        space = std::string("\"") +
                (type == BaseType::Color ? one_of(kColorSpaces) : one_of(kSpaces)) + "\" ";
    return std::string(type_name(type)) + " " + space + "(" + f() + ", " + f() + ", " + f() + ")";
}

std::string ShaderWriter::select(BaseType type, int depth) {
    return "(" + condition(depth - 1) + " ? " + value(type, depth - 1) + " : " +
           value(type, depth - 1) + ")";
}

// Array elements with wild indices, components.
std::string ShaderWriter::element(BaseType type, int depth) {
    if (Variable* v = variable(type, false, true))
        return read(*v) + "[" +
               (chance(60) ? value(BaseType::Float, depth - 1) : std::to_string(below(9) - 2)) +
               "]";
    if (type != BaseType::Float) return "";
    if (Variable* v = variable(BaseType::Color, false, false))
        return read(*v) + "[" + std::to_string(below(3)) + "]";
    return "";
}

std::string ShaderWriter::condition(int depth) {
    static const char* const kCompare[] = {" < ", " <= ", " > ", " >= ", " == ", " != "};
    int dice = below(100);
    if (depth > 0 && dice < 20)
        return "(" + condition(depth - 1) + (chance(50) ? " && " : " || ") + condition(depth - 1) +
               ")";
    if (depth > 0 && dice < 28) return "!(" + condition(depth - 1) + ")";
    if (dice < 34) return "(" + leaf(BaseType::String) + " == " + leaf(BaseType::String) + ")";
    if (dice < 38) return "(" + leaf(BaseType::Color) + " != " + leaf(BaseType::Color) + ")";
    return "(" + value(BaseType::Float, depth) + one_of(kCompare) + value(BaseType::Float, depth) +
           ")";
}

// ---- calls --------------------------------------------------------------------------------------

// "" if there is no row, or no variable for an output.
std::string ShaderWriter::row_call(BaseType type, int depth) {
    std::vector<Callable>& list = rows_[type];
    if (list.empty()) return "";
    const Callable& callable = list[size_t(below(int(list.size())))];
    const Builtin& row = *callable.row;
    if (row.name == std::string_view("directlighting") ||
        row.name == std::string_view("indirectspecular"))
        return "";  // of the methods of a class, which it gives to its own evaluateSamples
    if (uniform_ && (row.effects != kPure || *row.globals != 0)) return "";
    const auto& signatures = callable.signatures;
    const Signature& signature = signatures[size_t(below(int(signatures.size())))];
    std::string text;
    bool saved = uniform_;
    if (row.effects & kUniformOnly) uniform_ = true;
    bool ok = arguments(row, signature, depth, text);
    uniform_ = saved;
    if (!ok) return "";
    std::string call = std::string(row.name) + "(" + text + ")";
    bool stated = type != BaseType::Void && type != BaseType::String;
    return stated ? std::string(type_name(type)) + " " + call : call;
}

bool ShaderWriter::arguments(const Builtin& row, const Signature& signature, int depth,
                             std::string& text) {
    auto separate = [&] { text += text.empty() ? "" : ", "; };
    bool format = signature.repeats && signature.repeated.type.base == BaseType::Invalid;
    size_t fixed = signature.arguments.size();
    if (format) {  // "%f %c", then a value for each
        std::string pattern, values;
        for (int k = below(4); k > 0; --k) {
            BaseType type = chance(50) ? BaseType::Float : value_type();
            if (type == BaseType::Matrix) type = BaseType::Point;
            pattern += std::string("%") + conversion_of(type) + " ";
            values += ", " + (row.effects == kPure ? literal(type) : value(type, depth - 1));
        }
        text = "\"" + pattern + "\"" + values;
        return true;
    }
    for (size_t k = 0; k < fixed; ++k) {
        separate();
        if (!argument(row, signature.arguments[k], depth, text)) return false;
    }
    for (int k = signature.repeats ? below(4) : 0; k > 0; --k) {
        separate();
        if (!argument(row, signature.repeated, depth, text)) return false;
    }
    if (signature.pairs && chance(25))
        text += (chance(50) ? ", \"blur\", " : ", \"width\", ") + literal(BaseType::Float);
    return true;
}

bool ShaderWriter::argument(const Builtin& row, const Signature::Argument& argument, int depth,
                            std::string& text) {
    BaseType type = argument.type.base;
    if (argument.output || argument.type.is_array()) {
        bool array = argument.type.is_array();
        Variable* v =
            argument.output ? output_variable(type, array, 4) : variable(type, false, array, 4);
        if (!v) return false;
        text += argument.output ? v->name : read(*v);
        return true;
    }
    if (type == BaseType::String)
        text += "\"" + text_for(row.name) + "\"";
    else if (is_spatial(type) && std::count(std::begin(kUnitRows), std::end(kUnitRows), row.name))
        text += std::string(type_name(type)) + " normalize(" + value(type, depth - 1) + " + " +
                type_name(type) + " (0.1, 0.2, 0.3))";
    else
        text += value(type == BaseType::Invalid ? BaseType::Float : type, depth - 1);
    return true;
}

std::string ShaderWriter::text_for(std::string_view row) {
    for (const Vocabulary& v : kVocabulary)
        if (v.row == row) return v.words[size_t(below(int(v.words.size())))];
    return one_of(kSpaces);
}

std::string ShaderWriter::user_call(BaseType type, int depth) {
    if (calls_left_ <= 0 || uniform_) return "";
    for (const UserFunction& f : functions_) {
        if (f.result != type || chance(30)) continue;
        std::string text;
        Variable* given = nullptr;  // the last output argument: another may be the same variable
        for (const Signature::Argument& a : f.arguments) {
            Variable* v = nullptr;
            if (a.output && given && given->type == a.type.base && chance(40))
                v = given;
            else if (a.output)
                v = given = output_variable(a.type.base, false, 1);
            if (a.output && !v) return "";
            text += (text.empty() ? "" : ", ") + (v ? v->name : value(a.type.base, depth - 1));
        }
        --calls_left_;
        return f.name + "(" + text + ")";
    }
    return "";
}

}  // namespace kinora::rsl
