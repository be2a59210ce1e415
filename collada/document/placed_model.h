// collada/document/placed_model.h: a document that is shown at a place of another one's world.
#pragma once

#include <string>

#include "runtime/base/math.h"

namespace kinora::collada {

struct PlacedModel {
    std::string name;      // of the node that places it
    std::string document;  // for read_document
    std::string scene_id;  // the visual scene that is meant, or ""
    dmat4 place{1.0};      // metres, x to the right, z up: into the same of the world
};

}  // namespace kinora::collada
