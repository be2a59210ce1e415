// runtime/picture/shading/frame/light_layers.cpp
#include "runtime/picture/shading/frame/light_layers.h"

#include <algorithm>

namespace kinora {

void LayerErrors::add(size_t look, float error) {
    of_look.resize(std::max(of_look.size(), look + 1), 0.0f);
    of_look[look] = std::max(of_look[look], error);
}

}  // namespace kinora
