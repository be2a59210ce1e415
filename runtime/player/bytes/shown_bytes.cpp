// runtime/player/bytes/shown_bytes.cpp: to_8_bit from a table.
#include "runtime/player/bytes/shown_bytes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "runtime/base/check.h"
#include "runtime/base/parallel.h"

namespace kinora {

namespace {

constexpr size_t kRun = kByteRun;

// to_8_bit's function of a component grows, so 255 thresholds say it all. A step of the table has
// one of them at most.
class ByteSteps {
  public:
    explicit ByteSteps(ColorEncoding encoding) {
        std::array<uint32_t, 257> least{};  // bits of each byte's least number
        for (int v = 1; v < 256; ++v) {
            uint32_t low = 0, high = std::bit_cast<uint32_t>(2.0f);  // not yet v; v or more
            while (high - low > 1) {
                uint32_t middle = low + (high - low) / 2;
                (byte_of(std::bit_cast<float>(middle), encoding) >= v ? high : low) = middle;
            }
            least[size_t(v)] = high;
        }
        least[256] = std::bit_cast<uint32_t>(std::numeric_limits<float>::infinity());
        for (uint32_t k = 0; k < kStepCount; ++k) {
            const uint32_t begin = (uint32_t(kFirstStep) + k) << kStepShift;
            const uint32_t v = byte_of(std::bit_cast<float>(begin), encoding);
            const uint32_t from = std::min(least[v + 1] - begin, 1u << kStepShift);
            steps_[k] = int32_t(from << 8 | v);
            if (k > 0) CHECK_LE(int32_t(v), (steps_[k - 1] & 255) + 1);
        }
    }
    const int32_t* steps() const { return steps_.data(); }

  private:
    static uint8_t byte_of(float c, ColorEncoding encoding) {
        raytrace::Film pixel(1, 1);
        pixel.rgba[0] = {c, 0, 0, 1};
        return to_8_bit(pixel, encoding).rgba[0];
    }

    std::array<int32_t, kStepCount> steps_{};
};

const int32_t* steps_of(ColorEncoding encoding) {
    static const ByteSteps linear(ColorEncoding::Linear), srgb(ColorEncoding::Srgb);
    return (encoding == ColorEncoding::Linear ? linear : srgb).steps();
}

// At the end of a row, whose pixels are fewer than a run, and where not all is finite.
void few_bytes(std::span<const vec4> pixels, ColorEncoding encoding, uint8_t* to,
               const ByteKernels& kernels) {
    vec4 run[kRun] = {};
    uint8_t bytes[4 * kRun];
    std::ranges::copy(pixels, run);
    if (kernels.bytes(&run[0].x, steps_of(encoding), steps_of(ColorEncoding::Linear), bytes)) {
        std::copy_n(bytes, 4 * pixels.size(), to);
        return;
    }
    raytrace::Film film(int(pixels.size()), 1);
    std::ranges::copy(pixels, film.rgba.begin());
    std::ranges::copy(to_8_bit(film, encoding).rgba, to);
}

}  // namespace

void shown_bytes(std::span<const vec4> pixels, ColorEncoding encoding, uint8_t* to,
                 const ByteKernels& kernels) {
    const int32_t *steps = steps_of(encoding), *alphas = steps_of(ColorEncoding::Linear);
    for (size_t at = 0; at < pixels.size(); at += kRun) {
        const size_t count = std::min(kRun, pixels.size() - at);
        if (count < kRun || !kernels.bytes(&pixels[at].x, steps, alphas, to + 4 * at))
            few_bytes(pixels.subspan(at, count), encoding, to + 4 * at, kernels);
    }
}

void fast_8_bit(const raytrace::Film& film, ColorEncoding encoding, std::vector<uint8_t>& out) {
    out.resize(4 * film.rgba.size());
    parallel_for(0, film.rgba.size(), 4096, [&](size_t begin, size_t end) {
        shown_bytes(std::span(film.rgba).subspan(begin, end - begin), encoding, &out[4 * begin]);
    });
}

}  // namespace kinora
