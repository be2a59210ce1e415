// runtime/scene/build/instances/vertex_inputs.cpp: vertex inputs for the varying parameters of
// shaders.
#include "runtime/scene/build/instances/vertex_inputs.h"

#include <algorithm>
#include <set>

#include "runtime/scene/description/given_globals.h"
#include "runtime/scene/description/picture_rules.h"

namespace kinora {

namespace {

// Finds the inputs of one layer after the other.
class InputFinder {
  public:
    InputFinder(const PrimitiveGroup& group, const MaterialUse* use) : group_(group), use_(use) {
        inputs_.st = find_attribute(group, "TEXCOORD");
    }

    void add_layer(uint32_t index, const ShaderUse& layer) {
        layer_ = index;
        for (const ParamSource& source : layer.params) add_texture(source);
        for (const rsl::GlobalInfo* global : layer.shader->globals_read)
            add_global(layer, global->name);
        for (const rsl::ShaderParameter& p : layer.shader->parameters) add_parameter(layer, p);
        for (const rsl::VertexRequest& request : layer.shader->vertex_requests)
            add_request(layer, request);
    }

    VertexInputs take() { return std::move(inputs_); }

  private:
    void add(std::string name, std::string semantic, const VertexAttribute* attribute,
             uint32_t component, uint32_t components) {
        VaryingParam varying;
        varying.name = std::move(name);
        varying.semantic = std::move(semantic);
        varying.set = attribute ? attribute->set : kNone;
        varying.layer = layer_;
        varying.components = components;
        varying.component = component;
        inputs_.varying.push_back(std::move(varying));
        inputs_.attributes.push_back(attribute);
    }

    // A vertex input as the layer reads it.
    const VertexAttribute* read_by(const ShaderUse& layer, const VertexAttribute* a) const {
        if (!a || !layer.linear_inputs || a->semantic != "COLOR") return a;
        const VertexAttribute* linear = find_attribute(group_, kLinearColor, a->set);
        return linear ? linear : a;
    }

    // A file's texcoord names bind sets; the first one is s and t.
    void add_texture(const ParamSource& source) {
        if (source.strings.empty() || !source.name.ends_with("_map")) return;
        const VertexAttribute* st = texture_coordinates(group_, use_, source.texcoord);
        if (!any_texture_) {
            any_texture_ = true;
            if (st) inputs_.st = st;
        } else if (st && st != inputs_.st) {
            std::string slot = source.name.substr(0, source.name.size() - 4);
            add(slot + "_s", "TEXCOORD", st, 0, 1);
            add(slot + "_t", "TEXCOORD", st, 1, 1);
        }
    }

    // Cs and Os, as the mesh has them by name or, Cs, as colours.
    void add_global(const ShaderUse& layer, std::string_view name) {
        if (!is_given_global(name)) return;
        if (const VertexAttribute* given = find_attribute(group_, name);
            given && given->stride >= 3)
            add(std::string(name), std::string(name), given, 0, 3);
        else if (name == "Cs")
            add_color(layer);
    }

    void add_color(const ShaderUse& layer) {
        if (layer.untinted || (layer.linear_inputs && gives_color(layer))) return;
        const VertexAttribute* color = read_by(layer, find_attribute(group_, "COLOR"));
        if (color && color->stride >= 3) add("Cs", "COLOR", color, 0, 3);
    }

    // Whether the file has the colors for a parameter: then they do not tint as well.
    bool gives_color(const ShaderUse& layer) const {
        auto is_parameter = [&](const VertexBinding& binding) {
            return binding.semantic == "COLOR" &&
                   std::ranges::any_of(layer.shader->parameters, [&](const auto& parameter) {
                       return parameter.name == binding.param;
                   });
        };
        return use_ && std::ranges::any_of(use_->vertex_bindings, is_parameter);
    }

    void add_parameter(const ShaderUse& layer, const rsl::ShaderParameter& p) {
        if (p.type.is_array() || p.type.base == rsl::BaseType::String) return;
        // Of a co-shader's parameter, HANDLE.NAME, the part behind the handle.
        add_input(layer, std::string(p.name), p.name.substr(p.name.rfind('.') + 1), p.type.base);
    }

    // `input` as the file names it, for a parameter or request of that name and type.
    void add_input(const ShaderUse& layer, std::string name, std::string_view input,
                   rsl::BaseType type) {
        uint32_t components = uint32_t(rsl::component_count(type));
        const VertexBinding* binding = find_binding(use_, input);
        const VertexAttribute* attribute =
            binding ? find_attribute(group_, binding->semantic, binding->set)
                    : find_attribute(group_, input);
        attribute = read_by(layer, attribute);
        if (attribute)
            add(std::move(name), attribute->semantic, attribute, 0, components);
        else if (input == "Pref" && components == 3)
            add(std::move(name), "Pref", nullptr, 0, 3);
    }

    // A name that is known at run time alone may be that of any input.
    void add_request(const ShaderUse& layer, const rsl::VertexRequest& request) {
        if (request.type == rsl::BaseType::String) return;
        std::set<std::string> names{request.name};
        if (request.name.empty()) names = all_names();
        for (const std::string& name : names)
            add_input(layer, rsl::vertex_request_name(request.type, name), name, request.type);
    }
    std::set<std::string> all_names() const {
        std::set<std::string> names{"Pref"};
        for (const VertexAttribute& a : group_.attributes) names.insert(a.semantic);
        if (use_)
            for (const VertexBinding& binding : use_->vertex_bindings) names.insert(binding.param);
        names.erase(std::string(kLinearColor));
        return names;
    }

    const PrimitiveGroup& group_;
    const MaterialUse* use_;
    VertexInputs inputs_;
    uint32_t layer_ = 0;
    bool any_texture_ = false;
};

void remove_input(VertexInputs& inputs, uint32_t layer, std::string_view name) {
    for (size_t k = inputs.varying.size(); k-- > 0;)
        if (inputs.varying[k].layer == layer && inputs.varying[k].name == name) {
            inputs.varying.erase(inputs.varying.begin() + ptrdiff_t(k));
            inputs.attributes.erase(inputs.attributes.begin() + ptrdiff_t(k));
        }
}

VaryingParam displaced_param(const rsl::ShaderParameter& p, uint32_t layer) {
    VaryingParam varying;
    varying.name = std::string(p.name);
    varying.semantic = "vertex:" + varying.name;
    varying.layer = layer;
    varying.text = p.type.base == rsl::BaseType::String;
    varying.array = p.type.is_array();
    varying.components =
        uint32_t(rsl::component_count(p.type.base) * (varying.array ? p.type.array_length : 1));
    return varying;
}

}  // namespace

VertexInputs find_vertex_inputs(const PrimitiveGroup& group, const MaterialUse* use,
                                std::span<const ShaderUse> layers) {
    InputFinder finder(group, use);
    for (uint32_t l = 0; l < layers.size(); ++l) finder.add_layer(l, layers[l]);
    return finder.take();
}

void add_displaced_inputs(std::span<const ShaderUse> layers, uint32_t done_layers,
                          VertexInputs& inputs) {
    for (uint32_t l = 0; l < done_layers; ++l)
        for (const rsl::ShaderParameter& p : layers[l].shader->parameters) {
            if (!p.output) continue;
            remove_input(inputs, l, p.name);
            inputs.varying.push_back(displaced_param(p, l));
            inputs.attributes.push_back(nullptr);
        }
}

}  // namespace kinora
