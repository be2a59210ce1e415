// runtime/scene/dae/import_material.cpp: COLLADA's effects, materials and lights as RSL shaders
// with their parameters.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rsl/link.h"
#include "runtime/scene/dae/import_p.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/description/texture_name.h"
#include "runtime/scene/profile_rsl/effect_shaders.h"
#include "runtime/scene/profile_rsl/findings.h"

namespace kinora {

EffectLinker& ColladaImport::linker() {
    if (linker_) return *linker_;
    rsl::CompileOptions options;
    options.include_directories = options_.include_directories;
    options.files = out_.readable;
    options.pictures = out_.pictures;
    return linker_.emplace(data_, std::move(options), diagnostics_);
}

ValueSlot ColladaImport::param_slot(uint32_t material, uint32_t effect, uint32_t param) const {
    const auto& setparams = data_.materials[material].setparams;
    if (auto set = setparam_of_[material].find(param); set != setparam_of_[material].end())
        return {setparam_values_[material][set->second],
                uint32_t(setparams[set->second].value.numbers.size())};
    return {param_values_[effect][param],
            uint32_t(data_.effects[effect].params[param].value.numbers.size())};
}

// The file of an image. One that names none is an empty file inside the scene's, so that it shows
// checks as a missing one does.
std::string ColladaImport::image_path(const collada::Image& image) {
    if (!image.path.empty()) return image.path;
    if (!image.uri.empty()) return image.uri;
    auto none = std::make_shared<MemoryFile>(out_.path + "#" + image.id, std::vector<uint8_t>());
    out_.memory_files.push_back(none);
    return none->name();
}

// The image that a string names, and how it is looked up: "normals?data,clamp_s".
std::string ColladaImport::image_name(const collada::Image& image, std::string_view text,
                                      Location where) {
    TextureName name;
    name.path = image_path(image);
    size_t mark = text.find('?');
    if (text != image.id && mark != std::string_view::npos &&
        !set_texture_words(text.substr(mark + 1), name))
        diagnostics_.report(Code::RSL_IMAGE_WORDS, where, text.substr(mark + 1));
    return texture_name_string(name);
}

std::optional<ShaderUse> ColladaImport::shader_use(uint32_t material, const collada::Effect& effect,
                                                   const collada::RslShader& from) {
    BoundShader shader{&from, uint32_t(&effect - data_.effects.data()), material};
    ShaderUse use;
    use.shader = linker().linked(shader);
    if (!use.shader) return std::nullopt;  // errors were reported
    add_binds(shader, "", use);
    if (!use.shader->parts.empty())
        for (const BoundShader& co_shader : linker().co_shaders(shader))
            add_binds(co_shader, co_shader.from->handle + ".", use);
    return use;
}

// What the <bind>s of the shader, or of one of its co-shaders, give; handles are linked.
void ColladaImport::add_binds(const BoundShader& shader, const std::string& prefix,
                              ShaderUse& use) {
    std::shared_ptr<const rsl::Shader> alone = linker().chosen(shader);
    for (const collada::RslBind& bind : shader.from->binds) {
        if (rsl::find_handle_parameter(*alone, bind.symbol)) continue;
        bool unheard = prefix.empty() || told_.insert(&bind).second;
        const rsl::ShaderParameter* parameter = find_parameter(*alone, bind.symbol);
        if (!parameter) {
            if (unheard) bound_parameter(*alone, bind, diagnostics_);
            continue;
        }
        if (!find_parameter(*use.shader, prefix + bind.symbol)) continue;  // it is not called
        ParamSource source;
        source.name = prefix + bind.symbol;
        source.where = bind.where;
        bool from_param = bind.param != collada::kNone;
        const collada::ParamValue& value = bound_value(data_, shader, bind);
        if (value.type == collada::ParamType::String) {
            source.strings = value.strings;
            if (value.image != collada::kNone) {
                source.strings = {
                    image_name(data_.images[value.image], value.strings.back(), bind.where)};
            }
        } else {
            source.value = from_param ? param_slot(shader.material, shader.effect, bind.param)
                                      : ValueSlot{append(value), uint32_t(value.numbers.size())};
        }
        if (unheard) check_named_files(value, out_.pictures, bind.where, diagnostics_);
        if (!takes(*parameter, value)) {
            if (unheard)
                diagnostics_.report(Code::RSL_BIND_TYPE, bind.where, bind.symbol,
                                    rsl::type_name(parameter->type), value_text(value));
            continue;
        }
        use.params.push_back(std::move(source));
    }
}

void ColladaImport::rsl_material(uint32_t index, const collada::Effect& effect,
                                 MaterialDefinition& result) {
    size_t volumes = 0;
    result.light_samples = data_.materials[index].samples;
    result.light_shadows = data_.materials[index].shadows;
    for (const collada::RslShader& shader : effect.rsl->shaders) {
        if (shader.stage == collada::RslStage::CoShader) continue;  // linked with the others
        std::vector<ShaderUse>* stack = nullptr;
        if (shader.stage == collada::RslStage::Surface) stack = &result.surfaces;
        if (shader.stage == collada::RslStage::Displacement) stack = &result.displacements;
        if (shader.stage == collada::RslStage::Transformation) stack = &result.transformations;
        if (shader.stage == collada::RslStage::Light) stack = &result.lights;
        if (shader.stage == collada::RslStage::Volume) {
            std::string_view target = volume_side(data_.materials[index], volumes++);
            stack = target == "exterior" ? &result.exterior : &result.interior;
            if (!target.empty() && target != "exterior" && target != "interior")
                diagnostics_.report(Code::RSL_VOLUME_TARGET, shader.where, target);
        }
        if (shader.stage == collada::RslStage::Imager) {
            diagnostics_.report(Code::RSL_STAGE_PLACE, shader.where, "IMAGER", "a surface");
            continue;
        }
        if (!stack) {
            diagnostics_.report(Code::RSL_STAGE_NOT_RENDERED, shader.where,
                                stage_name(shader.stage));
            continue;
        }
        if (auto use = shader_use(index, effect, shader)) stack->push_back(std::move(*use));
    }
}

const collada::TextureSampler& ColladaImport::sampler_of(uint32_t material, uint32_t number) const {
    const collada::Material& from = data_.materials[material];
    for (const auto& [own, sampler] : from.samplers)
        if (own == number) return sampler;
    return data_.effects[from.effect].samplers[number];
}

void ColladaImport::set_texture(uint32_t material, const collada::CommonValue& value,
                                const char* name, bool data, ShaderUse& use) {
    const collada::TextureSampler& sampler = sampler_of(material, value.sampler);
    if (sampler.image == collada::kNone) return;
    const collada::Image& image = data_.images[sampler.image];
    TextureName texture;
    texture.path = image_path(image);
    auto wrap = [](collada::Wrap w) {
        return w == collada::Wrap::None ? TextureWrap::Border : TextureWrap(w);
    };
    texture.wrap_s = wrap(sampler.wrap_s);
    texture.wrap_t = wrap(sampler.wrap_t);
    texture.nearest_magnified = sampler.mag == collada::Filter::Nearest;
    texture.nearest_minified = sampler.min == collada::Filter::Nearest;
    texture.mip = sampler.mip == collada::Filter::None      ? TextureMip::None
                  : sampler.mip == collada::Filter::Nearest ? TextureMip::Nearest
                                                            : TextureMip::Linear;
    texture.mip_bias = sampler.mip_bias;
    texture.mip_max_level = sampler.mip_max_level;
    double turn = std::fmod(sampler.turn_degrees, 360.0);
    bool quarters = std::fmod(turn, 90.0) == 0;  // exact, whatever the library's cosine
    texture.turn = {
        float(quarters ? std::round(std::cos(radians(turn))) : std::cos(radians(turn))),
        float(quarters ? std::round(std::sin(radians(turn))) : std::sin(radians(turn)))};
    texture.data = data;
    texture.border = {sampler.border_color.x, sampler.border_color.y, sampler.border_color.z,
                      sampler.border_color.w};
    texture.uv = {sampler.repeat.x, sampler.repeat.y, sampler.offset.x, sampler.offset.y};
    ParamSource source;
    source.name = std::string(name) + "_map";
    source.strings = {texture_name_string(texture)};
    source.texcoord = value.texcoord;
    source.where = value.where;
    use.params.push_back(std::move(source));
}

namespace {

using collada::CommonSlot;

// Slots of profile_COMMON that are parameters of collada_*.sl, as colors or numbers.
struct ReadSlot {
    CommonSlot slot;
    const char* name;
    uint32_t count;
    bool display;  // a colour of light, encoded as a display's; <transparent> is a measure
};
constexpr ReadSlot kReadSlots[] = {
    {CommonSlot::Emission, "emission", 3, true},
    {CommonSlot::Ambient, "ambient_color", 3, true},
    {CommonSlot::Diffuse, "diffuse", 3, true},
    {CommonSlot::Specular, "specular", 3, true},
    {CommonSlot::Shininess, "shininess", 1, false},
    {CommonSlot::Reflective, "reflective", 3, true},
    {CommonSlot::Reflectivity, "reflectivity", 1, false},
    {CommonSlot::Transparent, "transparent", 3, false},
    {CommonSlot::Transparency, "transparency", 1, false},
    {CommonSlot::IndexOfRefraction, "index_of_refraction", 1, false},
};
constexpr const char* kShaderOfModel[] = {"collada_constant", "collada_lambert", "collada_phong",
                                          "collada_blinn"};                    // CommonModel
constexpr const char* kOpaque[] = {"A_ONE", "RGB_ZERO", "A_ZERO", "RGB_ONE"};  // Opaque
constexpr const char* kReversed[] = {"A_ZERO", "RGB_ONE", "A_ONE", "RGB_ZERO"};

// Only what the shader has a parameter for.
void add_value(ShaderUse& use, const char* name, ValueSlot value) {
    if (!find_parameter(*use.shader, name)) return;
    ParamSource source;
    source.name = name;
    source.value = value;
    use.params.push_back(std::move(source));
}

void add_text(ShaderUse& use, const char* name, const char* text) {
    ParamSource source;
    source.name = name;
    source.strings = {text};
    use.params.push_back(std::move(source));
}

bool has_map(const ShaderUse& use, const std::string& slot) {
    return find_parameter(*use.shader, slot + "_map");
}

bool transparent(const collada::CommonShading& common) {
    return common[CommonSlot::Transparent].source != collada::SlotSource::Absent ||
           common[CommonSlot::Transparency].source != collada::SlotSource::Absent;
}

const char* opaque_mode(const collada::CommonShading& common, bool reversed) {
    if (!transparent(common)) return "NONE";
    return (reversed ? kReversed : kOpaque)[size_t(common.opaque)];
}

}  // namespace

void ColladaImport::common_material(uint32_t index, const collada::Effect& effect,
                                    MaterialDefinition& result) {
    const collada::CommonShading& common = *effect.common;
    uint32_t effect_index = uint32_t(&effect - data_.effects.data());
    ShaderUse use;
    use.shader = library_shader(kShaderOfModel[size_t(common.model)]);
    use.linear_inputs = true;
    // What hides all is left out: the shader's own values are opaque, but for A_ZERO and RGB_ZERO
    // a transparency of 0 is. The mask of a texture stays.
    bool hides_all =
        data_.materials[index].invisible && options_.transparency == TransparencyMode::Auto;
    bool emits_body = common.emission_is_factor && options_.emission == EmissionMode::Auto;
    for (const ReadSlot& row : kReadSlots) {
        const collada::CommonValue& value = common[row.slot];
        bool factor = emits_body && row.slot == CommonSlot::Emission;
        bool mask = row.slot == CommonSlot::Transparent;
        ValueSlot slot;
        if (value.source == collada::SlotSource::Value)
            slot = {common_values_[effect_index][size_t(row.slot)], value.slot.count};
        else if (value.source == collada::SlotSource::Param)
            slot = param_slot(index, effect_index, value.param);
        else if (value.source == collada::SlotSource::Texture && has_map(use, row.name))
            set_texture(index, value, row.name, mask, use);
        bool left_out = hides_all && (mask || row.slot == CommonSlot::Transparency);
        if ((slot.count < row.count && slot.count != 1) || left_out) continue;
        ValueSlot whole{slot.offset, std::min(slot.count, row.count)};  // one number: a grey
        add_value(use, row.name, row.display && !factor ? linear(whole) : whole);
        if (mask && slot.count >= 4) add_value(use, "transparent_alpha", {slot.offset + 3, 1});
    }
    if (emits_body) {
        double whole = 1;
        add_value(use, "emission_of_body", {append(&whole, 1), 1});
    }
    bool zero_hides =
        common.opaque == collada::Opaque::AZero || common.opaque == collada::Opaque::RgbZero;
    if (hides_all && zero_hides) {
        double opaque = 0;
        add_value(use, "transparency", {append(&opaque, 1), 1});
    }
    const bool reversed =
        data_.materials[index].reversed && options_.transparency == TransparencyMode::Auto;
    add_text(use, "opaque", opaque_mode(common, reversed));
    if (common[CommonSlot::Bump].source == collada::SlotSource::Texture && has_map(use, "bump")) {
        set_texture(index, common[CommonSlot::Bump], "bump", true, use);
        add_text(use, "bump_kind", common.bump_is_normals ? "NORMALMAP" : "HEIGHTFIELD");
        add_value(use, "bump_amount", {append(&common.bump_amount, 1), 1});
    }
    result.surfaces.push_back(std::move(use));
}

// What <bind semantic target> gives a parameter; the colours of profile_COMMON as its own are.
ValueSlot ColladaImport::bound_slot(uint32_t material, const collada::ParamBinding& param) {
    ValueSlot value = slot(param.ref);
    uint32_t effect = material == kNone ? kNone : data_.materials[material].effect;
    if (effect == kNone || data_.effects[effect].rsl || value.count < 3) return value;
    for (const ReadSlot& row : kReadSlots)
        if (row.display && param.semantic == row.name) return linear({value.offset, 3});
    return value;
}

MaterialDefinition ColladaImport::material(uint32_t index) {
    const collada::Material& from = data_.materials[index];
    MaterialDefinition result;
    result.id = from.id;
    result.name = from.name;
    if (from.effect == collada::kNone) return result;
    const collada::Effect& effect = data_.effects[from.effect];
    if (effect.rsl)
        rsl_material(index, effect, result);
    else if (effect.common)
        common_material(index, effect, result);
    // An extra of profile_COMMON that holds for profile_RSL beside it, too.
    if (effect.common) result.hide_backfaces = !effect.common->double_sided;
    return result;
}

void ColladaImport::import_materials() {
    // Materials of lights, cameras and scenes are looked at where those are imported.
    std::vector<bool> bound(data_.materials.size(), false);
    for (const collada::Node& node : data_.nodes)
        for (const collada::MeshInstance& mesh : node.meshes)
            for (const collada::MaterialBinding& binding : mesh.materials)
                if (binding.material != collada::kNone) bound[binding.material] = true;
    for (uint32_t m = 0; m < data_.materials.size(); ++m) {
        MaterialDefinition unused;
        unused.id = data_.materials[m].id;
        unused.name = data_.materials[m].name;
        out_.materials.push_back(bound[m] ? material(m) : std::move(unused));
    }
}

PictureShaders ColladaImport::picture_shaders(const std::vector<uint32_t>& materials) {
    PictureShaders result;
    for (uint32_t m : materials) {
        uint32_t index = data_.materials[m].effect;
        if (index == collada::kNone || !data_.effects[index].rsl) continue;
        const collada::Effect& effect = data_.effects[index];
        for (const collada::RslShader& shader : effect.rsl->shaders) {
            if (shader.stage == collada::RslStage::CoShader) continue;
            std::vector<ShaderUse>* stack = nullptr;
            if (shader.stage == collada::RslStage::Volume) stack = &result.atmosphere;
            if (shader.stage == collada::RslStage::Imager) stack = &result.imagers;
            if (!stack)
                diagnostics_.report(Code::RSL_STAGE_PLACE, shader.where, stage_name(shader.stage),
                                    "a scene or camera");
            else if (auto use = shader_use(m, effect, shader))
                stack->push_back(std::move(*use));
        }
    }
    return result;
}

void ColladaImport::import_lights() {
    using collada::LightSlot;
    static constexpr const char* kKinds[] = {"collada_ambient", "collada_directional",
                                             "collada_point", "collada_spot"};
    static constexpr const char* kSlotNames[] = {"lightcolor",         "constant_attenuation",
                                                 "linear_attenuation", "quadratic_attenuation",
                                                 "falloff_angle",      "falloff_exponent"};
    for (size_t l = 0; l < data_.lights.size(); ++l) {
        const collada::Light& from = data_.lights[l];
        LightDefinition& to = out_.lights.emplace_back();
        to.id = from.id;
        to.name = from.name;
        to.where = from.where;
        to.shadows = from.shadows;
        if (from.rsl_material != collada::kNone) {
            uint32_t effect = data_.materials[from.rsl_material].effect;
            if (effect != collada::kNone && data_.effects[effect].rsl)
                for (const collada::RslShader& shader : data_.effects[effect].rsl->shaders)
                    if (shader.stage == collada::RslStage::Light && !to.shader.shader)
                        if (auto use = shader_use(from.rsl_material, data_.effects[effect], shader))
                            to.shader = std::move(*use);
        }
        if (to.shader.shader) continue;
        to.ambient = from.kind == collada::LightKind::Ambient;
        to.blender = from.blender;
        to.blender_watts = from.blender_watts;
        to.shader.shader = library_shader(kKinds[size_t(from.kind)]);
        for (size_t s = 0; s < size_t(LightSlot::Count); ++s) {
            if (!find_parameter(*to.shader.shader, kSlotNames[s])) continue;
            ParamSource source;
            source.name = kSlotNames[s];
            source.value = {light_values_[l][s], 1};
            if (s == size_t(LightSlot::Color)) source.value = linear({light_values_[l][s], 3});
            to.shader.params.push_back(std::move(source));
        }
    }
}

}  // namespace kinora
