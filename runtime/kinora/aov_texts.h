// runtime/kinora/aov_texts.h: what a picture's header says of its AOVs.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace kinora {

struct Scene;

// Texts as ImageTexts, of the planes that are in the file; none without AOVs. Values are JSON:
// "kinora/aov/NAME" has the filter, whether the channels are premultiplied, and their background;
// "kinora/id", "kinora/object_id" and "kinora/material_id" have the names behind the numbers.
std::vector<std::pair<std::string, std::string>> aov_texts(const Scene& scene);

}  // namespace kinora
