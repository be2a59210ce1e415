// raytrace/tile_job.cpp: a tile's samples, traced, shaded and laid one behind the other.
#include "raytrace/tile_job_p.h"

#include <algorithm>
#include <cmath>

#include "raytrace/sampling.h"
#include "runtime/base/stats.h"

namespace kinora::raytrace {

void IntegratorScratch::Thread::reserve(size_t chunk, size_t tile_pixels, size_t aovs) {
    if (slot_pixel.size() < chunk) {
        rays.count = 0;
        rays.reserve(chunk);
        hits.reserve(chunk);
        slot_pixel.resize(chunk);
        for (auto& v : color) v.resize(chunk);
        for (auto& v : through) v.resize(chunk);
        for (auto& v : shaded) v.resize(chunk + kPacket);
        passages.resize(chunk);
    }
    for (auto& v : sum) v.resize(std::max(v.size(), tile_pixels));
    if (shaded_aov.size() != aovs) {
        shaded_aov.resize(aovs);
        sum_aov.resize(aovs);
        aov_pointers.resize(aovs);
    }
    for (size_t k = 0; k < aovs; ++k) {
        shaded_aov[k].resize(std::max(shaded_aov[k].size(), chunk + kPacket));
        sum_aov[k].resize(std::max(sum_aov[k].size(), tile_pixels));
        aov_pointers[k] = shaded_aov[k].data();
    }
}

void TileJob::run(const Tile& tile) {
    tile_ = tile;
    begin_tile();
    const int per_chunk = std::max(1, int(settings_.chunk_rays / tile.pixels()));
    for (int first = 0; first < settings_.samples_per_pixel && !shading_.stopped();
         first += per_chunk) {
        make_rays(first, std::min(settings_.samples_per_pixel, first + per_chunk));
        const size_t slots = m_.rays.count;
        follow_layers();
        finish_samples(slots);
    }
    write_tile();
    shading_.end_tile(thread_);
}

void TileJob::begin_tile() {
    for (auto& v : m_.sum) std::fill_n(v.begin(), tile_.pixels(), 0.0);
    for (auto& v : m_.sum_aov) std::fill_n(v.begin(), tile_.pixels(), 0.0);
}

void TileJob::make_rays(int first_sample, int end_sample) {
    m_.rays.count = 0;
    m_.rays.passing = false;
    for (int sample = first_sample; sample < end_sample; ++sample)
        for (int by = tile_.y0; by < tile_.y1; by += kBlock)
            for (int bx = tile_.x0; bx < tile_.x1; bx += kBlock)
                for (int y = by; y < std::min(by + kBlock, tile_.y1); ++y)
                    for (int x = bx; x < std::min(bx + kBlock, tile_.x1); ++x)
                        add_ray(uint32_t(x), uint32_t(y), uint32_t(sample));
    for (int c = 0; c < 3; ++c) {
        std::fill_n(m_.color[c].begin(), m_.rays.count, 0.0f);
        std::fill_n(m_.through[c].begin(), m_.rays.count, 1.0f);
    }
}

void TileJob::add_ray(uint32_t x, uint32_t y, uint32_t sample) {
    dvec2 offset{0.0};
    if (settings_.samples_per_pixel > 1) {
        const dvec2 u = stratified_sample(sample, hash(x, y, settings_.seed));
        offset = {filter_.offset(u.x), filter_.offset(u.y)};
    }
    const CameraRay ray = camera_ray(camera_, x + 0.5 + offset.x, y + 0.5 + offset.y);
    RayBatch& r = m_.rays;
    const size_t k = r.count++;
    for (int c = 0; c < 3; ++c) {
        r.org[c][k] = r.first_org[c][k] = ray.org[c];
        r.dir[c][k] = ray.dir[c];
        r.dOdx[c][k] = ray.dorg_dx[c];
        r.dOdy[c][k] = ray.dorg_dy[c];
        r.dDdx[c][k] = ray.ddir_dx[c];
        r.dDdy[c][k] = ray.ddir_dy[c];
    }
    r.tnear[k] = ray.tnear;
    r.tfar[k] = ray.tfar;
    r.time[k] = 0;
    r.t_passed[k] = 0;
    r.pixel_x[k] = x;
    r.pixel_y[k] = y;
    r.sample[k] = sample;
    r.layer[k] = 0;
    r.medium[k] = 0;
    r.share[k] = r.weight[k] = 1;
    r.turns[k] = r.spent[k] = 0;
    r.slot[k] = uint32_t(k);
    m_.slot_pixel[k] = uint32_t(tile_.pixel(x, y));
}

// Each round traces the rays that still see through, and shades all their hits at once.
void TileJob::follow_layers() {
    for (int layer = 0; m_.rays.count > 0; ++layer) {
        Stopwatch watch;
        const HitBatch& hits =
            trace(accel_, m_.rays, kMaskAll | kMaskCamera, 0, m_.hits, m_.counters.trace);
        m_.counters.trace_ms += watch.restart();
        if (shading_.miss_distance() > 0) shade_misses(hits);
        if (hits.count == 0) return;
        if (layer == settings_.max_layers) {  // what is left is not seen
            m_.counters.too_deep += hits.count;
            return;
        }
        shade(hits);
        m_.counters.shade_ms += watch.ms();
        keep_aovs(hits);
        composite(hits);
    }
}

// What lies along the rays that leave the scene ends them.
void TileJob::shade_misses(const HitBatch& hits) {
    Stopwatch watch;
    const HitBatch& ends = missed(m_.rays, hits, shading_.miss_distance(), m_.misses);
    if (ends.count == 0) return;
    shade(ends, Ends::Nothing);
    for (size_t k = 0; k < ends.count; ++k) lay_behind(ends, k);
    m_.counters.shade_ms += watch.ms();
}

void TileJob::shade(const HitBatch& hits, Ends ends) {
    const size_t padded = (hits.count + kPacket - 1) / kPacket * kPacket;
    for (auto& v : m_.shaded) std::fill_n(v.begin(), padded, 0.0f);
    for (auto& v : m_.shaded_aov) std::fill_n(v.begin(), padded, 0.0f);
    ShadeResult result{{m_.shaded[0].data(), m_.shaded[1].data(), m_.shaded[2].data()},
                       {m_.shaded[3].data(), m_.shaded[4].data(), m_.shaded[5].data()},
                       m_.aov_pointers,
                       m_.passages.data()};
    std::fill_n(m_.passages.begin(), hits.count, Passage{});
    if (ends == Ends::Surfaces)
        shading_.shade(hits, thread_, result);
    else
        shading_.shade_misses(hits, thread_, result);
    m_.counters.shading_points += hits.count;
    mend(hits);
}

void TileJob::mend(const HitBatch& hits) {
    for (size_t k = 0; k < hits.count; ++k) {
        if (mend_hit(k)) continue;
        ++m_.counters.non_finite;
        m_.counters.non_finite_geometry =
            std::min(m_.counters.non_finite_geometry, hits.geometry[k]);
    }
}

// Replaces what is not finite; returns whether all was finite. Zero gives a black, covered point:
// an Oi that is not finite becomes 1, so that nothing shines through a fault.
bool TileJob::mend_hit(size_t k) {
    float zero = 0;  // NaN if anything is not finite
    for (const auto& v : m_.shaded) zero += v[k] * 0.0f;
    for (const auto& v : m_.shaded_aov) zero += v[k] * 0.0f;
    if (zero == 0) return true;
    if (settings_.nan == NanPolicy::Keep) return false;
    for (auto& v : m_.shaded_aov)
        if (!std::isfinite(v[k])) v[k] = 0;
    bool color_good = true;
    for (const auto& v : m_.shaded) color_good &= std::isfinite(v[k]);
    if (color_good) return false;
    const bool magenta = settings_.nan == NanPolicy::Magenta;
    for (int c = 0; c < 3; ++c) {
        m_.shaded[c][k] = magenta && c != 1 ? 1.0f : 0.0f;
        if (magenta || !std::isfinite(m_.shaded[3 + c][k])) m_.shaded[3 + c][k] = 1;
    }
    return false;
}

// Is it the first surface along its ray that is there at all?
bool TileJob::shows_first(const HitBatch& hits, size_t k) const {
    const size_t slot = m_.rays.slot[hits.ray[k]];
    bool clear = true, there = false;
    for (int c = 0; c < 3; ++c) {
        clear = clear && m_.through[c][slot] == 1.0f;
        there = there || m_.shaded[3 + c][k] != 0;
    }
    return clear && there;
}

void TileJob::keep_aovs(const HitBatch& hits) {
    for (size_t plane = 0; plane < m_.sum_aov.size(); ++plane) {
        const bool first_only = film_.aovs[plane].filter == AovFilter::FirstSample;
        const double weight = first_only ? 1.0 : 1.0 / settings_.samples_per_pixel;
        for (size_t k = 0; k < hits.count; ++k) {
            if ((first_only && hits.sample[k] != 0) || !shows_first(hits, k)) continue;
            m_.sum_aov[plane][m_.slot_pixel[m_.rays.slot[hits.ray[k]]]] +=
                weight * double(m_.shaded_aov[plane][k]);
        }
    }
}

void TileJob::lay_behind(const HitBatch& hits, size_t k) {
    const size_t slot = m_.rays.slot[hits.ray[k]];
    const float onward = m_.passages[k].onward;
    for (int c = 0; c < 3; ++c) {
        float& through = m_.through[c][slot];
        m_.color[c][slot] += through * m_.shaded[c][k];
        through *= (1.0f - std::clamp(m_.shaded[3 + c][k], 0.0f, 1.0f)) * onward;
    }
}

// Lays the hits behind what is there and keeps, in place, the rays that go on.
void TileJob::composite(const HitBatch& hits) {
    size_t going_on = 0;
    for (size_t k = 0; k < hits.count; ++k) {
        lay_behind(hits, k);
        if (!passes(m_.rays.slot[hits.ray[k]])) continue;
        const uint32_t medium = shading_.medium_behind(hits, k);
        pass_through(accel_, m_.rays, going_on, hits, k);
        m_.rays.turns[going_on] = m_.passages[k].turns;
        m_.rays.spent[going_on] = m_.passages[k].spent;
        m_.rays.weight[going_on] = largest_through(m_.rays.slot[going_on]);
        m_.rays.medium[going_on++] = medium;
    }
    m_.rays.count = going_on;
    m_.rays.passing = true;
}

float TileJob::largest_through(size_t slot) const {
    return std::max({m_.through[0][slot], m_.through[1][slot], m_.through[2][slot]});
}

bool TileJob::passes(size_t slot) const {
    return largest_through(slot) > 1.0f - settings_.opaque_above;
}

void TileJob::finish_samples(size_t slots) {
    for (size_t slot = 0; slot < slots; ++slot) {
        const size_t pixel = m_.slot_pixel[slot];
        double coverage = 0;
        for (int c = 0; c < 3; ++c) {
            const double through = double(m_.through[c][slot]);
            double color = double(m_.color[c][slot]);
            if (settings_.background) color += through * double((*settings_.background)[c]);
            m_.sum[c][pixel] += color;
            coverage += (1 - through) / 3;
        }
        m_.sum[3][pixel] += settings_.background ? 1.0 : coverage;
    }
}

void TileJob::write_tile() const {
    const double weight = 1.0 / settings_.samples_per_pixel;
    size_t pixel = 0;
    for (int y = tile_.y0; y < tile_.y1; ++y)
        for (int x = tile_.x0; x < tile_.x1; ++x, ++pixel) {
            vec4& out = film_.at(x, y);
            for (int c = 0; c < 4; ++c) out[c] = float(weight * m_.sum[c][pixel]);
            const size_t at = size_t(y) * size_t(film_.width) + size_t(x);
            for (size_t k = 0; k < m_.sum_aov.size(); ++k)
                film_.aovs[k].values[at] = float(m_.sum_aov[k][pixel]);
        }
}

}  // namespace kinora::raytrace
