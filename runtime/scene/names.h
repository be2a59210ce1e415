// runtime/scene/names.h: what stands in a scene by name and by number.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/scene/lights.h"
#include "runtime/scene/nodes.h"
#include "runtime/scene/shapes.h"

namespace kinora {

// The id of a definition, else its name.
const std::string& shown_name(const std::string& id, const std::string& name);

// "torso/head/eye", by ids; of a node with neither id nor name its number from 1: "#7".
std::string number_name(uint32_t node);
std::string node_path(const SceneNodes& scene, uint32_t node);

// Of each light what its AOV is called: "light_" and the name of its node, else its own, in letters
// that channels may have. Lights of one name are told apart by a number.
std::vector<std::string> light_aov_names(const SceneNodes& nodes, const SceneLights& lights);

// The name of a surface's material; "default" where it has none.
std::string material_name(const SceneDescription& description, uint32_t material);

// Numbers of a surface's node and material, from 1: they stay the same in all frames of a scene. 1
// is the default material.
uint32_t object_id(const SceneShapes& shapes, const Surface& surface);
uint32_t material_id(const Surface& surface);

// The options' frames a second, else the file's.
double frames_per_second(const SceneResources& scene);

// A number with its name.
struct IdName {
    uint32_t id = 0;
    std::string name;
};
// Of what the scene's surfaces have, each once, in the order of the numbers. A surface is called
// like its node and its material, parted by a space.
std::vector<IdName> surface_names(const SceneNodes& nodes, const SceneShapes& shapes);
std::vector<IdName> object_names(const SceneNodes& nodes, const SceneShapes& shapes);
std::vector<IdName> material_names(const SceneNodes& nodes, const SceneShapes& shapes);

}  // namespace kinora
