// runtime/scene/shaders/queries.h: what shaders ask about each other, the geometry, the ray and the
// renderer: the service "query".
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "jit/ir/kernel_call.h"
#include "rsl/model/renderer_services.h"
#include "runtime/scene/shaders/picture_points.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

struct Scene;
struct SceneLights;
struct SceneNodes;
struct SceneShaders;
struct Surface;

// Who asks: a point of a grid, or nobody in particular (frame rate).
struct Asker {
    const SceneNodes& nodes;
    const SceneShapes& shapes;
    const SceneLights& lights;
    const SceneShaders& shaders;
    const Pose& pose;
    const ShaderInstance& look;
    const PicturePoints* seen = nullptr;
    size_t point = 0;   // of the grid
    int32_t light = 0;  // QueryKind::Light: among Scene::lights

    uint32_t hit() const { return seen->points[point]; }
    bool on_surface() const { return seen && seen->hits.instance[hit()] != kNone; }
    const Surface& surface() const;  // that the grid's point lies on
};

// What is asked for: a number of a type (letters of rsl/model/builtin.h), or an element of an
// array.
struct Query {
    std::string_view name;
    char type = 'f';
    int element = -1;  // of an array of `length`; -1: no array; rsl::kQueryLength: how long it is
    int length = 1;
    bool triple() const { return type == 'c' || type == 'p' || type == 'v' || type == 'n'; }
    int components() const { return triple() ? 3 : type == 'm' ? 16 : 1; }
};

// An answer: up to 16 numbers, a string's id bit for bit.
using QueryAnswer = std::array<float, 16>;

// The service; lanes without an answer get known = 0.
// `seen`: the points that ask; null at frame rate.
void answer_query(const Scene& scene, const Pose& pose, const ShaderInstance& look,
                  const PicturePoints* seen, const jit::ServiceCall& call);

// Rows of attribute(), option(), rendererinfo() and rayinfo(): facts by their customary names; a
// prefix "Ri:" is the same without it. False where the name or the type is not known.
bool answer_fact(rsl::QueryKind kind, const Asker& asker, const Query& query, QueryAnswer& answer);

// Whether the answer is the same for all points of a grid.
bool is_same_for_grid(rsl::QueryKind kind, const Query& query);

// A shader parameter as it is bound (or its constant default): `kind` chooses the layer, the last
// one first. False if there is none of that name and type.
bool answer_parameter(const Asker& asker, const ShaderInstance& look, rsl::ShaderKind kind,
                      const Query& query, QueryAnswer& answer);

}  // namespace kinora
