// runtime/scene/build/instances/instance_compiler.cpp: shader instances compiled for a scene.
#include "runtime/scene/build/instances/instance_compiler.h"

namespace kinora {

InstanceCompiler::InstanceCompiler(SceneResources& scene, Diagnostics& diagnostics)
    : scene_(scene), diagnostics_(diagnostics) {
    for (const NodeDefinition& node : scene.description->nodes)
        if (!node.id.empty()) space_names_.push_back(node.id);
}

bool InstanceCompiler::compile(ShaderInstance& instance, ShaderInstanceOptions wanted) {
    wanted.quality = scene_.options.quality;
    wanted.target = scene_.options.target;
    wanted.spaces = &space_names_;
    if (scene_.options.want_dumps)
        wanted.dumps = &scene_.options.dumps;  // of each instance
    else
        wanted.known = &known_;
    return compile_instance(instance, *scene_.description, wanted, diagnostics_);
}

}  // namespace kinora
