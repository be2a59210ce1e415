// raytrace/sampling.cpp: the scrambled (0,2)-sequence behind pixel samples.
#include "raytrace/sampling.h"

namespace kinora::raytrace {

dvec2 stratified_sample(uint32_t index, uint32_t seed) {
    const uint32_t x = owen_scramble_reversed(index, first_scramble(seed));
    const uint32_t y = owen_scramble_reversed(sobol_second_reversed(index), second_scramble(seed));
    return {unit_interval(x), unit_interval(y)};
}

}  // namespace kinora::raytrace
