// runtime/scene/shaders/scene_host.cpp: a scene's answers to its kernels, wherever they run.
#include "runtime/scene/shaders/scene_host.h"

#include <glm/matrix.hpp>

#include "runtime/scene/scene.h"
#include "runtime/scene/shaders/point_queries.h"
#include "runtime/scene/shaders/queries.h"
#include "runtime/scene/shaders/shader_instance.h"
#include "runtime/scene/spaces.h"

namespace kinora {

TextureStore& SceneHost::textures() const {
    return *scene_.textures;
}

TextureFilter SceneHost::best_filter() const {
    return scene_.options.quality.texture_filter;
}
dmat4 SceneHost::current_from_space(std::string_view name, size_t) const {
    return kinora::current_from_space(scene_, pose_, name, look_.space_owner());
}
dmat4 SceneHost::world_from_current() const {
    return glm::inverse(kinora::current_from_space(scene_, pose_, "world", kNone));
}
void SceneHost::texture3d(const jit::ServiceCall& call) {
    look_up_points(*scene_.points, pose_, call);
}
void SceneHost::photons(const jit::ServiceCall& call) {
    look_up_photons(*scene_.points, pose_, call);
}

void UnlitHost::query(const jit::ServiceCall& call) {
    answer_query(scene_, pose_, look_, nullptr, call);
}

void FrameHost::print(const jit::ServiceCall& call) {
    printed_.add(call, 0);
}
void FrameHost::show_printed() const {
    printed_.show(scene_.options.print);
}

dmat4 VertexHost::current_from_space(std::string_view name, size_t) const {
    return object_from_space(scene_, pose_, name, object_);
}
void VertexHost::print(const jit::ServiceCall& call) {
    for (int lane = 0; lane < call.lanes; ++lane)
        if (call.mask >> lane & 1) prints_.add(call, lane);
}

}  // namespace kinora
