// runtime/picture/explain/explain.h: what a scene's pictures model, what they leave out, and why.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/scene/pose.h"
#include "runtime/scene/quality/quality.h"

namespace kinora {

struct Scene;

struct Explained {
    std::string_view section;  // "meshes"
    std::string subject;       // of the file: "body on hips"
    bool modelled = true;      // false: it is left out, which costs nothing in a frame
    std::string what;          // "deforms"
    std::string why;
};

// What is modelled comes first in a section. Read off what the builder made and what the pose's
// frames so far used: kernels by their inputs, textures by what was opened. `quality` is what the
// scene was built for, `preset` the name it began with.
std::vector<Explained> explain(const Scene& scene, const Pose& pose, const Quality& quality,
                               std::string_view preset);

// Sections with a line a row, at most 20 rows a section and then their number; or one JSON object
// of arrays with all rows.
std::string explained_text(const std::vector<Explained>& rows);
std::string explained_json(const std::vector<Explained>& rows);

}  // namespace kinora
