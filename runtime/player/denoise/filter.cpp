// runtime/player/denoise/filter.cpp: rows in stretches, on all threads.
#include "runtime/player/denoise/filter.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "runtime/player/denoise/kernels.h"

namespace kinora {

namespace {

constexpr float kUnseen = 1e-7f;  // variance of linear light that no eye finds

void copy_run(const std::vector<float>& from, std::vector<float>& to, size_t at) {
    std::memcpy(&to[at], &from[at], kFilterRun * sizeof(float));
}

}  // namespace

void AtrousFilter::start(Planes& planes) {
    step_ = 1;
    for (auto* plane : {&c_[0], &c_[1], &c_[2], &c_[3], &variance_})
        plane->resize(planes.surface.size());
    const FilterKernels& kernels = filter_kernels();
    each_stretch(planes, [&](size_t at) {
        if (kernels.exceeds(&planes.variance[at], 0))
            kernels.smooth_variance(&planes.surface[at], &planes.variance[at], planes.stride,
                                    &variance_[at]);
        else
            copy_run(planes.variance, variance_, at);
    });
    std::swap(planes.variance, variance_);
}

void AtrousFilter::pass(Planes& planes) {
    const FilterKernels& kernels = filter_kernels();
    each_stretch(planes, [&](size_t at) {
        if (!kernels.exceeds(&planes.variance[at], kUnseen)) {
            for (int k = 0; k < 4; ++k) copy_run(planes.c[k], c_[k], at);
            copy_run(planes.variance, variance_, at);
            return;
        }
        const FilterGuide guide{{&planes.N[0][at], &planes.N[1][at], &planes.N[2][at]},
                                &planes.depth[at],
                                {&planes.slope[0][at], &planes.slope[1][at]},
                                &planes.albedo[at],
                                &planes.surface[at]};
        const FilterColors from{
            {&planes.c[0][at], &planes.c[1][at], &planes.c[2][at], &planes.c[3][at]},
            &planes.variance[at]};
        const FilterResult to{{&c_[0][at], &c_[1][at], &c_[2][at], &c_[3][at]}, &variance_[at]};
        kernels.pass(guide, from, step_, planes.stride, to);
    });
    for (int k = 0; k < 4; ++k) std::swap(planes.c[k], c_[k]);
    std::swap(planes.variance, variance_);
    step_ *= 2;
}

}  // namespace kinora
