// runtime/programs/shade/points_binding.h: values of --points for the parameters of a shader.
#pragma once

#include <map>

#include "rsl/lower/lower.h"
#include "rsl/model/kernel_keys.h"
#include "runtime/programs/shade/points_document.h"

namespace kinora {

// A value that fits a type: the numbers or texts of one value, or of one a point.
struct FittedValue {
    bool per_point = false;
    PointsValue value;
};

// Throws PointsError, which names `where`, if the value has neither the type's shape nor that of
// `count` of it. A single number spreads over a triple.
FittedValue fit_value(const std::string& where, const PointsValue& value, rsl::Type type,
                      size_t count);

// The numbers of parameters, by layer of the stack and name.
struct PointsNumbers {
    std::map<rsl::KernelKey, float> uniform;
    std::map<std::pair<uint32_t, int32_t>, FittedValue> varying;  // name: rsl::name_id
};

// The shader with its parameters: variables of the points go before its own values, which go before
// its defaults. Cs and Os are bound too. Throws PointsError.
rsl::Layer bind_points_layer(const rsl::Shader& shader, uint32_t index,
                             const PointsValues& parameters, const dmat4& current_from_shader,
                             const PointsDocument& document, PointsNumbers& numbers);

}  // namespace kinora
