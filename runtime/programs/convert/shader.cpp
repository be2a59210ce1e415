// runtime/programs/convert/shader.cpp: --shader: RSL into the effects of materials and lights.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "collada/document/edit.h"
#include "runtime/base/regular_file.h"
#include "runtime/programs/convert/convert.h"
#include "runtime/programs/convert/rsl_profile_p.h"
#include "runtime/programs/convert/worn_shaders_p.h"
#include "runtime/scene/description/display_color.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/load/override_scene.h"

namespace kinora {

using collada::Document;
using collada::Edit;
using collada::Element;

namespace {

using Stages = std::vector<const rsl::Shader*>;

std::optional<GivenShaders> read_given(const std::string& name, const rsl::CompileOptions& compile,
                                       Diagnostics& diag) {
    GivenShaders given;
    if (names_shader_file(name)) {
        for (auto& shader : rsl::compile_file(name, compile, diag))
            given.shaders.push_back(std::move(shader));
        if (given.shaders.empty() && !diag.has_errors())
            diag.report(Code::CONVERT_SHADER, Location{}, fmt::format("'{}' has no shader", name));
        given.code = read_regular_file(name).value_or("");
    } else if (std::shared_ptr<const rsl::Shader> ours = named_shader(name, diag)) {
        given.shaders.push_back(std::move(ours));
        given.code = library_shader_text(name);
    }
    if (given.shaders.empty()) return std::nullopt;
    given.bare_code = given.code;
    if (given.code.find('#') == given.code.npos) return given;
    std::string text = given.code;
    rsl::ShaderSource source{text, {}};
    source.map.file = diag.files.add(name, text);
    source.map.segments = {{0, 0}};
    given.bare_code = rsl::print_preprocessed(rsl::preprocess(source, compile, diag));
    if (text.find("#include") != text.npos) given.code = given.bare_code;
    return given;
}

// The first shader of each kind that a material can wear, LIGHT among them where it shall shine.
Stages for_materials(const GivenShaders& given, bool lights) {
    Stages stages;
    bool seen[6] = {};
    for (const auto& shader : given.shaders) {
        bool worn = shader->kind != rsl::ShaderKind::Imager &&
                    (lights || shader->kind != rsl::ShaderKind::Light);
        if (worn && !std::exchange(seen[size_t(shader->kind)], true))
            stages.push_back(shader.get());
    }
    return stages;
}

Stages for_lights(const GivenShaders& given) {
    for (const auto& shader : given.shaders)
        if (shader->kind == rsl::ShaderKind::Light) return {shader.get()};
    return {};
}

const Element* rsl_technique(const Element& owner) {
    for (const Element& extra : owner.children()) {
        if (extra.name != "extra") continue;
        for (const Element& technique : extra.children())
            if (technique.name == "technique" && technique.value("profile") == "RSL")
                return &technique;
    }
    return nullptr;
}

// COLLADA's colors are display values, those of profile_RSL linear.
std::string linear_bind(const char* param, std::string_view display) {
    std::string text(display);
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
    std::vector<double> numbers = parse_numbers(text).value_or(std::vector<double>{});
    numbers.resize(3, 1.0);
    dvec3 linear = linear_of_display({numbers[0], numbers[1], numbers[2]});
    return fmt::format("<bind symbol=\"{}\"><color>{} {} {}</color></bind>", param, linear.x,
                       linear.y, linear.z);
}

// What COLLADA's light gives to the light shader that takes its place, as parameters that the
// light shaders of COLLADA have (collada_*.sl).
OldParams values_of_light(const Element& light) {
    struct Row {
        const char *element, *param, *type, *initial;
        int kinds;  // 1: every light, 2: point and spot, 3: spot
    };
    // COLLADA 1.4.1, chapter 5, light: the defaults
    static constexpr Row kRows[] = {
        {"color", "lightcolor", "color", "1 1 1", 1},
        {"constant_attenuation", "constant_attenuation", "float", "1", 2},
        {"linear_attenuation", "linear_attenuation", "float", "0", 2},
        {"quadratic_attenuation", "quadratic_attenuation", "float", "0", 2},
        {"falloff_angle", "falloff_angle", "float", "180", 3},
        {"falloff_exponent", "falloff_exponent", "float", "0", 3}};
    OldParams old;
    const Element* common = light.child("technique_common");
    const Element* kind = common ? common->first_child : nullptr;
    if (!kind) return old;
    int number = kind->name == "spot" ? 3 : kind->name == "point" ? 2 : 1;
    for (const Row& row : kRows) {
        if (row.kinds > number) continue;
        const Element* value = kind->child(row.element);
        if (value && row.type == std::string_view("color")) {
            old.binds.emplace_back(row.param, linear_bind(row.param, value->text));
            continue;
        }
        old.binds.emplace_back(
            row.param,
            fmt::format("<bind symbol=\"{0}\"><{1}>{2}</{1}></bind>", row.param, row.type,
                        value ? collada::escape_text(value->text) : row.initial));
    }
    return old;
}

// One --shader on a document.
class ShaderEmbedding {
  public:
    ShaderEmbedding(const Document& document, std::string_view text, const std::string& output,
                    const std::string& name, const GivenShaders& given,
                    const rsl::CompileOptions& compile, WornShaders& worn, Diagnostics& diag)
        : document_(document),
          text_(text),
          output_(output),
          name_(name),
          given_(given),
          compile_(compile),
          worn_(worn),
          diag_(diag) {
        prefix_ = collada::prefix_of(text, document.root());
        look(document.root());
    }

    // False after an error, which is a finding.
    bool run(const std::string& pattern) {
        auto fits = [&](const Element* e) {
            return glob_matches(pattern, std::string(e->value("id")),
                                std::string(e->value("name")));
        };
        std::vector<Wearer> lights, materials;
        Stages light_stages = for_lights(given_);
        for (const Element* light : lights_)
            if (!light_stages.empty() && fits(light))
                lights.push_back({light, rsl_instance(*light)});
        Stages stages = for_materials(given_, lights.empty());
        for (const Element* material : materials_)
            if (!stages.empty() && fits(material))
                materials.push_back({material, material->child("instance_effect")});
        if (stages.empty() && light_stages.empty()) {
            diag_.report(Code::SHADER_OF_OTHER_KIND, Location{}, name_,
                         "surface, displacement, transformation, volume, light");
            return false;
        }
        if (lights.empty() && materials.empty()) {
            diag_.report(Code::MATERIAL_UNKNOWN, Location{}, pattern);
            return false;
        }
        return put_on(materials, stages) && put_on(lights, light_stages) && add_effects();
    }

    std::string text() { return collada::apply_edits(text_, std::move(edits_)); }

  private:
    struct Wearer {
        const Element* owner;     // <material> or <light>
        const Element* instance;  // <instance_effect>, or null
    };

    void look(const Element& e) {
        if (e.name == "instance_effect") instances_.push_back(&e);
        bool in_library =
            e.parent && e.parent->name == std::string("library_") + std::string(e.name) + "s";
        if (in_library && e.name == "light") lights_.push_back(&e);
        if (in_library && e.name == "material" && e.child("instance_effect"))
            materials_.push_back(&e);
        for (const Element& child : e.children()) look(child);
    }

    static const Element* rsl_instance(const Element& light) {
        const Element* technique = rsl_technique(light);
        return technique ? technique->child("instance_effect") : nullptr;
    }

    std::string fresh_id(std::string id) {
        while (document_.find(id) || taken_.contains(id)) id += "_";
        taken_.insert(id);
        return id;
    }

    bool put_on(const std::vector<Wearer>& wearers, const Stages& stages) {
        std::set<const Element*> chosen, done;
        for (const Wearer& w : wearers) chosen.insert(w.instance);
        for (const Wearer& w : wearers) {
            for (const rsl::Shader* shader : stages)
                worn_.put(w.owner->name, w.owner->value("id"), shader->kind, name_, diag_);
            if (!w.instance) {
                give_effect(*w.owner, stages);
                continue;
            }
            std::string_view url = w.instance->value("url");
            const Element* effect = url.starts_with('#') ? document_.find(url.substr(1)) : nullptr;
            if (!effect || effect->name != "effect") {
                diag_.report(Code::CONVERT_SHADER, Location{},
                             fmt::format("the effect '{}' of {} '{}' is not in this file", url,
                                         w.owner->name, w.owner->value("id")));
                return false;
            }
            if (done.insert(effect).second && !change_effect(*effect, url, stages, chosen))
                return false;
        }
        return true;
    }

    // The effect's copy where others, which are not chosen, wear it too.
    bool change_effect(const Element& effect, std::string_view url, const Stages& stages,
                       const std::set<const Element*>& chosen) {
        std::optional<std::string> markup =
            with_shaders(text_, prefix_, effect, given_, stages, output_, compile_);
        if (!markup) {
            diag_.report(Code::CONVERT_SHADER, Location{},
                         fmt::format("the code of '{}' contradicts that of the other shaders of "
                                     "effect '{}': give their functions different names",
                                     name_, effect.value("id")));
            return false;
        }
        bool shared = std::any_of(instances_.begin(), instances_.end(), [&](const Element* e) {
            return e->value("url") == url && !chosen.contains(e);
        });
        if (!shared) {
            edits_.push_back({effect.bytes, *markup});
            return true;
        }
        std::string id = fresh_id(std::string(effect.value("id")) + "-rsl");
        collada::ByteRange at = effect.attribute("id")->value_bytes;
        markup->replace(at.begin - effect.bytes.begin, at.end - at.begin,
                        collada::escape_attribute(id));
        edits_.push_back({{effect.bytes.end, effect.bytes.end}, std::move(*markup)});
        for (const Element* instance : chosen)
            if (instance && instance->value("url") == url)
                edits_.push_back(collada::set_attribute(text_, *instance, "url", "#" + id));
        return true;
    }

    // A light of COLLADA's own: an effect with the light's values, and the extra that names it.
    void give_effect(const Element& light, const Stages& stages) {
        std::string id = fresh_id(std::string(light.value("id")) + "-rsl");
        new_effects_ += "<effect " + collada::attribute_text("id", id) + ">" +
                        rsl_profile(stages, given_.code, values_of_light(light)) + "</effect>";
        std::string instance =
            "<instance_effect " + collada::attribute_text("url", "#" + id) + "/>";
        const Element* technique = rsl_technique(light);
        if (!technique)
            instance = "<extra><technique profile=\"RSL\">" + instance + "</technique></extra>";
        edits_.push_back(collada::append_child(text_, technique ? *technique : light,
                                               collada::prefixed(instance, prefix_)));
    }

    bool add_effects() {
        if (new_effects_.empty()) return true;
        if (const Element* library = document_.root().child("library_effects")) {
            edits_.push_back(
                collada::append_child(text_, *library, collada::prefixed(new_effects_, prefix_)));
            return true;
        }
        uint32_t at = document_.root().child("library_lights")->bytes.begin;
        edits_.push_back({{at, at},
                          collada::prefixed(
                              "<library_effects>" + new_effects_ + "</library_effects>", prefix_)});
        return true;
    }

    const Document& document_;
    std::string_view text_;
    const std::string &output_, &name_;
    const GivenShaders& given_;
    const rsl::CompileOptions& compile_;
    WornShaders& worn_;
    Diagnostics& diag_;
    std::string prefix_, new_effects_;
    std::set<std::string> taken_;
    std::vector<const Element*> instances_, materials_, lights_;
    std::vector<Edit> edits_;
};

}  // namespace

std::optional<std::string> embed_shaders(const std::string& path, std::string text,
                                         const ConvertOptions& options, Diagnostics& diag) {
    WornShaders worn;
    rsl::CompileOptions compile;
    compile.include_directories = options.include_directories;
    for (const auto& [pattern, name] : options.shaders) {
        std::optional<GivenShaders> given = read_given(name, compile, diag);
        if (!given) return std::nullopt;
        Diagnostics quiet;
        std::optional<Document> document = collada::read_document_text(path, text, quiet);
        if (!document || !document->whole()) return text;
        ShaderEmbedding embedding(*document, quiet.files.text(document->file()), options.output,
                                  name, *given, compile, worn, diag);
        if (!embedding.run(pattern)) return std::nullopt;
        text = embedding.text();
    }
    return text;
}

}  // namespace kinora
