// runtime/player/pixel/point_inputs.cpp: columns, frame values, spaces and records to inputs by
// name.
#include "runtime/player/pixel/point_inputs.h"

#include <algorithm>

#include "rsl/model/kernel_keys.h"
#include "runtime/picture/shading/grid.h"
#include "runtime/picture/shading/lighting/light_records.h"

namespace kinora {

namespace {

using rsl::KernelKey;
using Values = std::map<std::string, double>;

constexpr rsl::Partial kPartials[] = {rsl::Partial::None, rsl::Partial::Du, rsl::Partial::Dv};
constexpr size_t kMostSpaces = 64;

// All columns of a grid of one point.
class AllColumns {
  public:
    explicit AllColumns(const Grid& grid)
        : memory_(grid.memory),
          mark_(memory_.arena.mark()),
          all_(grid.frame, grid.memory, grid.hits, grid.points, grid.look) {
        Arena& arena = memory_.arena;
        all_.columns = arena.allocate_span<float*>(grid.look->column_count);
        for (float*& row : all_.columns) {
            row = arena.allocate_span<float>(padded(all_.count())).data();
            std::fill_n(row, padded(all_.count()), 0.0f);
        }
        gather(all_);
    }
    ~AllColumns() { memory_.arena.release(mark_); }
    AllColumns(const AllColumns&) = delete;
    float operator[](size_t column) const { return all_.columns[column][0]; }

  private:
    ThreadMemory& memory_;
    Arena::Mark mark_;
    Grid all_;
};

void add_globals(const AllColumns& columns, Values& values) {
    auto add = [&](const KernelKey& key) {
        uint16_t column = find_column(key);
        if (column == kNoColumn) return;
        float x = columns[column];
        bool bits = key.kind == rsl::KeyKind::Rng;
        values[rsl::text(key)] = bits ? double(jit::bits_of(x)) : double(x);
    };
    add(rsl::plain_key(rsl::KeyKind::One));
    add(rsl::plain_key(rsl::KeyKind::Rng));
    for (const rsl::GlobalInfo& global : rsl::globals())
        for (int k = 0; k < rsl::component_count(global.type.base); ++k)
            for (rsl::Partial partial : kPartials) {
                KernelKey key = rsl::global_key(global.id, k);
                key.partial = partial;
                add(key);
            }
}

void add_frame(const Pose& pose, Values& values) {
    values[rsl::text(rsl::global_key(rsl::Global::time))] = double(float(pose.time));
    values[rsl::text(rsl::global_key(rsl::Global::dtime))] = double(float(pose.shutter));
    values[rsl::text(rsl::plain_key(rsl::KeyKind::CameraNear))] = double(float(pose.view.znear));
    values[rsl::text(rsl::plain_key(rsl::KeyKind::CameraFar))] = double(float(pose.view.zfar));
}

void add_spaces(const GridHost& host, Values& values) {
    std::vector<std::string> names = {"world", "object", "shader", "screen", "NDC", "raster"};
    std::vector<std::string> own = space_names(*host.grid().frame.resources.description);
    if (own.size() > kMostSpaces) own = host.grid().look->spaces;
    names.insert(names.end(), own.begin(), own.end());
    for (const std::string& name : names) {
        dmat4 to = host.current_from_space(name, 0), from = glm::inverse(to);
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < 4; ++column) {
                values[rsl::text(rsl::space_key(name, true, row, column))] =
                    double(float(to[column][row]));
                values[rsl::text(rsl::space_key(name, false, row, column))] =
                    double(float(from[column][row]));
            }
    }
}

// Parameters that the mesh brings.
void add_varying(const ShaderInstance& look, const AllColumns& columns, Values& values) {
    for (const VaryingParam& param : look.varying) {
        if (param.column == kNoColumn) continue;
        rsl::BaseType type = rsl::BaseType::Float;
        if (param.name == "Cs" || param.name == "Os") type = rsl::BaseType::Color;
        for (const rsl::ShaderParameter& p : look.layers[param.layer].shader->parameters)
            if (p.name == param.name) type = p.type.base;
        for (uint32_t c = 0; c < param.components; ++c)
            for (rsl::Partial partial : kPartials) {
                KernelKey key =
                    rsl::parameter_key(param.layer, param.name, -1, rsl::form_of(type), int(c));
                key.partial = partial;
                float x = columns[param.column + uint32_t(partial) * param.components + c];
                values[rsl::text(key)] = param.text ? double(jit::bits_of(x)) : double(x);
            }
    }
}

double frame_number(const Grid& grid, const ShaderInstance& look, const KernelKey& key) {
    FrameInput input = parameter_input(look, key);
    switch (input.source) {
        case FrameInput::Source::Value:
            return double(float(grid.pose.values[input.index]));
        case FrameInput::Source::Spatial: {
            dmat4 m = current_from_space(grid.frame.nodes, grid.pose, "shader", look.space_owner());
            return double(float(parameter_in_current(
                input.type, m, &grid.pose.values[input.index])[input.component]));
        }
        default:
            return double(input.fixed);
    }
}

void add_parameters(const Grid& grid, const ShaderInstance& look,
                    const std::vector<rsl::Layer>& layers, Values& values) {
    for (uint32_t l = 0; l < layers.size(); ++l)
        for (const rsl::ShaderParameter& p : layers[l].shader->parameters) {
            auto bound =
                std::ranges::find_if(layers[l].params, [&](auto& b) { return b.name == p.name; });
            if (bound == layers[l].params.end() || bound->kind != rsl::ParamBinding::Kind::Frame)
                continue;
            bool array = p.type.is_array();
            for (int e = array ? 0 : -1; e < (array ? p.type.array_length : 0); ++e)
                for (int c = 0; c < rsl::component_count(p.type.base); ++c) {
                    KernelKey key = rsl::parameter_key(l, p.name, e, rsl::form_of(p.type.base), c);
                    values[rsl::text(key)] = frame_number(grid, look, key);
                }
        }
}

}  // namespace

std::vector<std::string> space_names(const SceneDescription& description) {
    std::vector<std::string> names;
    for (const NodeDefinition& node : description.nodes)
        if (!node.id.empty()) names.push_back(node.id);
    return names;
}

rsl::ReferenceInputs point_inputs(const GridHost& host, const std::vector<rsl::Layer>& layers) {
    const Grid& grid = host.grid();
    rsl::ReferenceInputs inputs;
    AllColumns columns(grid);
    add_globals(columns, inputs.values);
    add_frame(grid.pose, inputs.values);
    add_spaces(host, inputs.values);
    add_varying(*grid.look, columns, inputs.values);
    add_parameters(grid, *grid.look, layers, inputs.values);
    return inputs;
}

std::vector<std::string> record_names(const GridHost& host) {
    const ShadingFrame& frame = host.grid().frame;
    const jit::RecordSet& set = host.grid().record_sets[0];
    std::vector<std::string> names;
    for (int32_t r = 0; r < set.count; ++r) {
        const int32_t light = jit::bits_of(set.records[r].uniforms[rsl::kLightNumber]);
        const LightDefinition& definition =
            frame.resources.description->lights[frame.lights.lights[size_t(light)].definition];
        names.push_back(definition.name.empty() ? definition.id : definition.name);
    }
    return names;
}

std::vector<rsl::ReferenceLight> point_lights(const GridHost& host, const jit::RecordSet& set) {
    const Grid& grid = host.grid();
    const rsl::LoweredShader& lowered = grid.look->lowered;
    std::vector<rsl::ReferenceLight> lights;
    for (int32_t r = 0; r < set.count; ++r) {
        const jit::Record& record = set.records[r];
        rsl::ReferenceLight& light = lights.emplace_back();
        auto column = [&](size_t c) { return record.columns[c][0]; };
        light.kind = rsl::LightKind(jit::bits_of(record.uniforms[rsl::kLightKind]));
        int32_t categories = jit::bits_of(record.uniforms[rsl::kLightCategories]);
        for (size_t c = 0; c < lowered.categories.size(); ++c)
            light.known_categories.emplace_back(lowered.categories[c], (categories >> c & 1) != 0);
        light.nondiffuse = double(record.uniforms[rsl::kLightNondiffuse]);
        light.nonspecular = double(record.uniforms[rsl::kLightNonspecular]);
        light.which = jit::bits_of(record.uniforms[rsl::kLightNumber]);
        for (size_t k = 0; k < 3; ++k) {
            light.L[k] = double(column(rsl::kLightL + k));
            light.Cl[k] = double(column(rsl::kLightCl + k));
            light.Ol[k] = double(column(rsl::kLightOl + k));
        }
        light.lit = jit::bits_of(column(rsl::kLightLit)) != 0;
        light.sampled = jit::bits_of(record.uniforms[rsl::kLightSampled]) != 0;
        light.density = double(column(rsl::kLightDensity));
        for (size_t k = 0; k < 3; ++k) light.bare[k] = double(column(rsl::kLightBare + k));
        size_t next = rsl::kLightMessages;
        for (size_t m = 0; m < lowered.light_messages.size(); ++m) {
            size_t count = size_t(rsl::component_count(lowered.light_message_types[m].base)) *
                           size_t(std::max(lowered.light_message_types[m].array_length, 1));
            std::vector<double> numbers;
            for (size_t k = 0; k < count; ++k) numbers.push_back(double(column(next + k)));
            if (jit::bits_of(record.uniforms[rsl::kLightUniforms + m]) != 0)
                light.messages.emplace_back(lowered.light_messages[m], numbers);
            next += count;
        }
        light.number = r;
    }
    return lights;
}

}  // namespace kinora
