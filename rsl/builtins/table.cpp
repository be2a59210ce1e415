// rsl/builtins/table.cpp: decodes the rows and finds them by name.
#include "rsl/builtins/table.h"

#include <algorithm>
#include <unordered_map>

#include "runtime/base/check.h"

namespace kinora::rsl {

namespace {

Type type_of_letter(char letter) {
    constexpr std::string_view kLetters = "fcpvnmsx?";
    constexpr BaseType kTypes[] = {BaseType::Float,  BaseType::Color,  BaseType::Point,
                                   BaseType::Vector, BaseType::Normal, BaseType::Matrix,
                                   BaseType::String, BaseType::Void,   BaseType::Invalid};
    size_t at = kLetters.find(letter);
    CHECK_LT(at, kLetters.size());
    return {kTypes[at], -1};
}

Signature parse_signature(std::string_view text) {
    Signature signature;
    CHECK(text.size() >= 2 && text[1] == '=');
    signature.result = type_of_letter(text[0]);
    for (size_t i = 2; i < text.size(); ++i) {
        char c = text[i];
        if (c == '*') {
            signature.repeats = true;
            signature.repeated = signature.arguments.back();
            signature.arguments.pop_back();
        } else if (c == '~') {
            signature.pairs = true;
        } else if (c == '[') {
            signature.arguments.back().type.array_length = 0;
            ++i;
        } else {
            bool output = c >= 'A' && c <= 'Z';
            signature.arguments.push_back(
                {type_of_letter(output ? char(c - 'A' + 'a') : c), output});
        }
    }
    return signature;
}

}  // namespace

std::vector<Signature> parse_signatures(std::string_view text) {
    std::vector<Signature> signatures;
    while (!text.empty()) {
        size_t end = std::min(text.find(' '), text.size());
        if (end > 0) {
            signatures.push_back(parse_signature(text.substr(0, end)));
            signatures.back().overload = int(signatures.size()) - 1;
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return signatures;
}

const std::vector<BuiltinGroup>& builtin_groups() {
    static const std::vector<BuiltinGroup> groups = {
        {"Mathematics", builtins_math()},
        {"Filtered steps", builtins_filterstep()},
        {"Splines", builtins_spline()},
        {"Derivatives", builtins_derivatives()},
        {"Geometry", builtins_geometric()},
        {"Reflection", builtins_reflection()},
        {"Spaces", builtins_spaces()},
        {"Colors", builtins_color()},
        {"Noise", builtins_noise()},
        {"Lighting", builtins_light()},
        {"Rays", builtins_rays()},
        {"Occlusion and indirect light", builtins_occlusion()},
        {"Sampling lights", builtins_sampling()},
        {"Point files", builtins_points()},
        {"Textures", builtins_texture()},
        {"Environments and shadows", builtins_environment()},
        {"Bump maps", builtins_bump()},
        {"Facts about image files, baking", builtins_texture_files()},
        {"Matrices", builtins_matrix()},
        {"Resizable arrays", builtins_arrays()},
        {"Strings and printing", builtins_string()},
        {"Messages", builtins_message()},
        {"Of other renderers, not computed", builtins_foreign()},
    };
    return groups;
}

namespace {

struct Table {
    std::unordered_map<std::string_view, std::vector<Overload>> overloads;
    std::vector<std::string_view> names;

    Table() {
        for (const BuiltinGroup& group : builtin_groups())
            for (const Builtin& row : group) {
                std::vector<Overload>& list = overloads[row.name];
                if (list.empty()) names.push_back(row.name);
                for (Signature& s : parse_signatures(row.signature))
                    list.push_back({&row, std::move(s)});
            }
    }
};

const Table& table() {
    static const Table instance;
    return instance;
}

struct ForeignRow {
    std::string_view names;
    std::string_view origin;
};
constexpr ForeignRow kForeign[] = {
    {" urandom checkers clearlighting colormap ", "Pixie"},
    {" fulltrace rayserver ", "BMRT"},
    {" hash randomgrid subtexture rayhittest irradiance ", "other renderers"},
    {" getvar getshader getshaders getlights hasmethod "
     "evaluateSamples generateSamples ",
     "RSL 2.0"},
};

}  // namespace

std::span<const Overload> find_builtin(std::string_view name) {
    auto found = table().overloads.find(name);
    if (found == table().overloads.end()) return {};
    return found->second;
}

const std::vector<std::string_view>& builtin_names() {
    return table().names;
}

std::string_view foreign_builtin(std::string_view name) {
    std::string padded = " " + std::string(name) + " ";
    for (const ForeignRow& row : kForeign)
        if (row.names.find(padded) != std::string_view::npos) return row.origin;
    return "";
}

}  // namespace kinora::rsl
