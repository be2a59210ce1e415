// runtime/scene/description/interface_losses.cpp: what other formats cannot say of the RenderMan
// Interface.
#include "runtime/scene/description/interface_losses.h"

namespace kinora {

std::vector<std::string_view> interface_losses(const SceneDescription& description) {
    bool linked = false, textured = false;
    for_each_shader_use(description, [&](const ShaderUse& use) {
        linked |= !use.links.empty();
        for (const ParamSource& source : use.params) textured |= !source.strings.empty();
    });
    std::vector<std::string_view> losses;
    if (linked) losses.push_back("what layers of shaders get from layers below");
    if (!description.atmospheres.empty()) losses.push_back("the atmospheres of single surfaces");
    if (description.textures_from_top && textured)
        losses.push_back("that t = 0 is the top of its textures");
    return losses;
}

}  // namespace kinora
