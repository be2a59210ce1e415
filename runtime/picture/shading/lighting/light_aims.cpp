// runtime/picture/shading/lighting/light_aims.cpp: lights whose shaders send all of their light
// against where the light looks: most often shaders that were written for a "shader" space that
// looks along -z.
#include <algorithm>
#include <cmath>

#include "runtime/picture/shading/grid.h"
#include "runtime/picture/shading/lighting/light_aims.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/kernels/columns.h"
#include "runtime/scene/shaders/scene_host.h"

namespace kinora {

namespace {

// Rings around the axis, before the light and behind it; cones may be narrow.
constexpr double kRingDegrees[] = {0.5, 2, 5, 10, 20, 35, 55, 80};
constexpr int kOnRing = 4;
constexpr size_t kProbes = 2 * std::size(kRingDegrees) * kOnRing;
static_assert(kProbes % jit::kMaxLanes == 0);

// A point that is lit, in the light's space, as directions from it; at two distances.
dvec3 probe(size_t k, double size) {
    size_t ring = k / 2 / kOnRing;
    double angle = radians(kRingDegrees[ring]),
           turn = 2 * kPi * (double(k / 2 % kOnRing) + 0.3) / kOnRing;
    double z = k % 2 ? -std::cos(angle) : std::cos(angle);
    double distance = size * (k / 2 % 2 ? 1 : 0.1);
    return distance * dvec3(std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), z);
}

// Nobody reads what is printed here.
class SilentHost : public UnlitHost {
  public:
    using UnlitHost::UnlitHost;
    void print(const jit::ServiceCall&) override {}
};

// The probes through the light's kernel; a row for each output.
std::span<float*> run_probes(const ShadingFrame& frame, const ShaderInstance& look, Arena& arena) {
    const BoundKernel& bound = look.full;
    const jit::Kernel& kernel = bound.kernel();
    dmat4 current = current_from_space(frame.nodes, frame.pose, "shader", look.space_owner());
    dvec3 origin(current[3]);
    auto new_row = [&] {
        std::span<float> row = arena.allocate_span<float>(kProbes);
        std::fill(row.begin(), row.end(), 0.0f);
        return row.data();
    };
    auto value = [&](uint16_t column, dvec3 P) {
        dvec3 N = glm::normalize(origin - P);
        if (column >= kColPs && column < kColPs + 3) return float(P[column - kColPs]);
        if (column >= kColNs && column < kColNs + 3) return float(N[column - kColNs]);
        if (column >= kColN && column < kColN + 3) return float(N[column - kColN]);
        if (column >= kColP && column < kColP + 3) return float(origin[column - kColP]);
        return 0.0f;
    };
    std::span<float*> columns = arena.allocate_span<float*>(look.column_count);
    for (uint16_t column : bound.columns) {
        float* row = columns[column] = new_row();
        for (size_t k = 0; k < kProbes; ++k)
            row[k] = value(column, dvec3(current * dvec4(probe(k, frame.shapes.size), 1)));
    }
    std::span<float*> out = take_outputs(kernel, kProbes, arena);
    std::span<jit::RecordSet> records = arena.allocate_span<jit::RecordSet>(kRecordSets);
    std::fill(records.begin(), records.end(), jit::RecordSet{});
    std::span<uint8_t> faults = arena.allocate_span<uint8_t>(kernel.fault_sites.size());
    SilentHost host(frame.scene, frame.pose, look);
    bound.run({.count = kProbes,
               .frame = frame.instances[look.index].full,
               .columns = columns,
               .out = out,
               .faults = faults,
               .record_sets = records,
               .host = host},
              arena);
    return out;
}

}  // namespace

void report_aims(const ShadingFrame& frame, const LightBindings& bindings,
                 Diagnostics& diagnostics) {
    // The interface's lights are aimed by parameters of their own.
    if (frame.resources.description->file_picture) return;
    Arena arena;
    for (size_t l = 0; l < frame.lights.lights.size(); ++l) {
        const LightSource& light = frame.lights.lights[l];
        const ShaderInstance& look = *frame.shaders.shader_instances[light.look];
        // A shader that does not read its space has another aim, as the default lights have.
        bool aims = std::count(look.spaces.begin(), look.spaces.end(), "shader") > 0;
        if (look.area_light || !aims || !bindings.directed(l)) continue;
        arena.reset();
        std::span<float*> out = run_probes(frame, look, arena);
        dvec3 forward(current_from_space(frame.nodes, frame.pose, "shader", look.space_owner())[2]);
        bool before = false, behind = false;
        for (const LightOutputs& statement : bindings.statements(l)) {
            if (statement.kind == rsl::kLightAmbient || statement.L[0] < 0) continue;
            for (size_t k = 0; k < kProbes; ++k) {
                auto at = [&](int output) { return output < 0 ? 0.0f : out[size_t(output)][k]; };
                bool lit = statement.lit < 0 || jit::bits_of(at(statement.lit)) != 0;
                float most =
                    std::max({at(statement.Cl[0]), at(statement.Cl[1]), at(statement.Cl[2])});
                if (!lit || !(most > 0)) continue;
                dvec3 to_light(at(statement.L[0]), at(statement.L[1]), at(statement.L[2]));
                (glm::dot(to_light, forward) > 0 ? behind : before) = true;
            }
        }
        const LightDefinition& definition = frame.resources.description->lights[light.definition];
        if (behind && !before)
            diagnostics.report(Code::LIGHT_AIMS_BACK, definition.where,
                               definition.id.empty() ? definition.name : definition.id);
    }
}

}  // namespace kinora
