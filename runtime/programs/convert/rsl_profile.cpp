// runtime/programs/convert/rsl_profile.cpp: profile_RSL in the text of an effect.
#include "runtime/programs/convert/rsl_profile_p.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "collada/document/edit.h"
#include "rsl/text/findings.h"

namespace kinora {

using collada::Edit;
using collada::Element;

namespace {

constexpr const char* kStages[] = {"SURFACE", "DISPLACEMENT", "LIGHT",
                                   "VOLUME",  "IMAGER",       "TRANSFORMATION"};  // ShaderKind

std::string bytes_of(std::string_view text, const Element& e) {
    return std::string(text.substr(e.bytes.begin, e.bytes.end - e.bytes.begin));
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpace = " \t\r\n";
    size_t begin = text.find_first_not_of(kSpace);
    if (begin == text.npos) return {};
    return text.substr(begin, text.find_last_not_of(kSpace) + 1 - begin);
}

// A <shader> of each, with the old binds of parameters that it has.
std::string shader_elements(std::span<const rsl::Shader* const> shaders, const OldParams& old) {
    std::string elements;
    for (const rsl::Shader* shader : shaders) {
        elements += fmt::format("<shader stage=\"{}\"><name>{}</name>", stage_word(shader->kind),
                                shader->name);
        std::set<std::string> bound;
        for (const auto& [symbol, bind] : old.binds)
            for (const rsl::ShaderParameter& parameter : shader->parameters)
                if (parameter.name == symbol && bound.insert(symbol).second) elements += bind;
        elements += "</shader>";
    }
    return elements;
}

std::string code_element(const std::string& code) {
    return "<code>" + collada::cdata(code) + "</code>";
}

// A function's definition from its name on, without white space.
std::string definition_at(std::string_view code, size_t begin) {
    std::string text;
    int depth = 0;
    for (char c : code.substr(begin)) {
        if (!std::isspace(uint8_t(c))) text += c;
        depth += c == '{' ? 1 : c == '}' ? -1 : 0;
        if (c == '}' && depth == 0) break;
    }
    return text;
}

// A technique that keeps some of its shaders.
class TechniqueChange {
  public:
    TechniqueChange(std::string_view text, const Element& technique,
                    std::span<const rsl::Shader* const> shaders)
        : text_(text) {
        for (const Element& child : technique.children()) {
            if (child.name == "code") codes_.push_back(&child);
            has_includes_ |= child.name == "include";
            if (!first_code_ && (child.name == "code" || child.name == "include"))
                first_code_ = &child;
            if (child.name != "pass") continue;
            if (!pass_) pass_ = &child;
            for (const Element& shader : child.children()) {
                if (shader.name != "shader") continue;
                bool replaced = std::any_of(shaders.begin(), shaders.end(), [&](auto* given) {
                    return shader.value("stage") == stage_word(given->kind);
                });
                (replaced ? replaced_ : kept_).push_back(&shader);
            }
        }
    }

    bool keeps_some() const { return pass_ && first_code_ && !kept_.empty(); }

    // False: the codes contradict each other.
    bool run(const std::string& code, const std::string& elements, std::string_view prefix,
             const std::string& path, const rsl::CompileOptions& compile,
             std::vector<Edit>& edits) {
        if (!has_includes_ && !drop_unused(code, path, compile)) return false;
        for (const Element* e : replaced_) edits.push_back(collada::erase_element(text_, *e));
        for (const Element* e : dropped_) edits.push_back(collada::erase_element(text_, *e));
        // In front: it has no macros, and those of the others do not reach it.
        edits.push_back({{first_code_->bytes.begin, first_code_->bytes.begin},
                         collada::prefixed(code_element(code), prefix)});
        edits.push_back(collada::append_child(text_, *pass_, collada::prefixed(elements, prefix)));
        return true;
    }

  private:
    using Shaders = std::vector<std::unique_ptr<rsl::Shader>>;

    // Nothing where it has errors, or where a function behind `own` bytes is not as one in them.
    static std::optional<Shaders> compiled(const std::string& joined, const std::string& path,
                                           const rsl::CompileOptions& compile, size_t own = 0) {
        Diagnostics quiet;
        rsl::ShaderSource source{joined, {}};
        source.map.file = quiet.files.add(path, joined);
        source.map.segments = {{0, 0}};
        Shaders shaders = rsl::compile(source, compile, quiet);
        if (quiet.has_errors()) return std::nullopt;
        for (const Finding& f : quiet.findings()) {
            if (f.info != &rsl::Code::RSL_FUNCTION_REDEFINED || f.notes.empty()) continue;
            size_t first = f.notes[0].where.begin, second = f.where.begin;
            if (first < own && second >= own &&
                definition_at(joined, first) != definition_at(joined, second))
                return std::nullopt;
        }
        return shaders;
    }

    bool holds_all_kept(const Shaders& shaders) const {
        return std::all_of(kept_.begin(), kept_.end(), [&](const Element* kept) {
            const Element* name = kept->child("name");
            return std::any_of(shaders.begin(), shaders.end(), [&](const auto& shader) {
                return stage_word(shader->kind) == kept->value("stage") &&
                       (!name || trimmed(name->text) == shader->name);
            });
        });
    }

    // Codes of shaders that are replaced go, where nothing else needs them.
    bool drop_unused(const std::string& code, const std::string& path,
                     const rsl::CompileOptions& compile) {
        auto all_but = [&](const Element* left_out) {
            std::string joined = code + "\n";
            for (const Element* c : codes_)
                if (c != left_out &&
                    std::find(dropped_.begin(), dropped_.end(), c) == dropped_.end())
                    joined += std::string(c->text) + "\n";
            return compiled(joined, path, compile, code.size());
        };
        for (const Element* candidate : codes_) {
            std::optional<Shaders> alone = compiled(std::string(candidate->text), path, compile);
            if (!alone || alone->empty()) continue;
            std::optional<Shaders> rest = all_but(candidate);
            if (rest && holds_all_kept(*rest)) dropped_.push_back(candidate);
        }
        return all_but(nullptr).has_value();
    }

    std::string_view text_;
    const Element *pass_ = nullptr, *first_code_ = nullptr;
    std::vector<const Element*> codes_, kept_, replaced_, dropped_;
    bool has_includes_ = false;
};

}  // namespace

const char* stage_word(rsl::ShaderKind kind) {
    return kStages[size_t(kind)];
}

std::string rsl_profile(std::span<const rsl::Shader* const> shaders, const std::string& code,
                        const OldParams& old) {
    return "<profile_RSL>" + old.params + "<technique sid=\"rsl\">" + code_element(code) +
           "<pass>" + shader_elements(shaders, old) + "</pass></technique></profile_RSL>";
}

OldParams old_params(std::string_view text, const Element& effect) {
    OldParams found;
    std::vector<std::pair<std::string, std::string>> alike;  // behind the binds that were written
    auto look_in = [&](const Element& scope, bool in_profile) {
        for (const Element& p : scope.children()) {
            if (p.name != "newparam") continue;
            if (in_profile) found.params += bytes_of(text, p);
            std::string sid = collada::escape_attribute(p.value("sid"));
            alike.emplace_back(
                std::string(p.value("sid")),
                fmt::format("<bind symbol=\"{0}\"><param ref=\"{0}\"/></bind>", sid));
        }
    };
    look_in(effect, false);
    if (const Element* profile = effect.child("profile_RSL")) {
        look_in(*profile, true);
        if (const Element* technique = profile->child("technique")) {
            look_in(*technique, true);
            for (const Element& pass : technique->children())
                for (const Element& shader : pass.children())
                    for (const Element& bind : shader.children())
                        if (bind.name == "bind")
                            found.binds.emplace_back(std::string(bind.value("symbol")),
                                                     bytes_of(text, bind));
        }
    }
    found.binds.insert(found.binds.end(), alike.begin(), alike.end());
    return found;
}

std::optional<std::string> with_shaders(std::string_view text, std::string_view prefix,
                                        const Element& effect, const GivenShaders& given,
                                        std::span<const rsl::Shader* const> shaders,
                                        const std::string& path,
                                        const rsl::CompileOptions& compile) {
    std::vector<Edit> edits;
    const Element* profile = effect.child("profile_RSL");
    const Element* technique = profile ? profile->child("technique") : nullptr;
    OldParams old = old_params(text, effect);
    std::optional<TechniqueChange> change;
    if (technique) change.emplace(text, *technique, shaders);
    if (change && change->keeps_some()) {
        if (!change->run(given.bare_code, shader_elements(shaders, old), prefix, path, compile,
                         edits))
            return std::nullopt;
    } else {
        std::string markup = collada::prefixed(rsl_profile(shaders, given.code, old), prefix);
        if (profile)
            edits.push_back({profile->bytes, markup});
        else if (const Element* extra = effect.child("extra"))
            edits.push_back({{extra->bytes.begin, extra->bytes.begin}, markup});
        else
            edits.push_back(collada::append_child(text, effect, markup));
    }
    for (Edit& e : edits) {
        e.bytes.begin -= effect.bytes.begin;
        e.bytes.end -= effect.bytes.begin;
    }
    return collada::apply_edits(bytes_of(text, effect), std::move(edits));
}

}  // namespace kinora
