// raytrace/tiles/tile_job.cpp: a tile's samples, traced, shaded and laid one behind the other.
#include "raytrace/tiles/tile_job_p.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "raytrace/hits.h"
#include "raytrace/sampling.h"

namespace kinora::raytrace {

void IntegratorScratch::Thread::reserve(size_t chunk, size_t tile_pixels, size_t aovs) {
    if (passages.size() < chunk) {
        rays.count = 0;
        rays.reserve(chunk);
        hits.reserve(chunk);
        samples.reserve(chunk);
        for (auto& v : color) v.resize(chunk);
        for (auto& v : through) v.resize(chunk);
        for (auto& v : shaded) v.resize(chunk + kPacket);
        passages.resize(chunk);
    }
    order.reserve(tile_pixels);
    sum.resize(std::max(sum.size(), 4 * tile_pixels));
    held.resize(std::max(held.size(), 3 * tile_pixels));
    if (shaded_aov.size() != aovs) {
        shaded_aov.resize(aovs);
        aov_pointers.resize(aovs);
    }
    for (size_t k = 0; k < aovs; ++k) {
        shaded_aov[k].resize(std::max(shaded_aov[k].size(), chunk + kPacket));
        aov_pointers[k] = shaded_aov[k].data();
    }
}

void TileOrder::reserve(size_t pixels) {
    if (x.size() >= pixels) return;
    width = height = 0;
    for (auto* v : {&x, &y, &scramble[0], &scramble[1]}) v->resize(pixels);
}

void TileOrder::set_size(int w, int h) {
    if (w == width && h == height) return;
    width = w, height = h;
    size_t i = 0;
    for (int by = 0; by < h; by += kBlock)
        for (int bx = 0; bx < w; bx += kBlock)
            for (uint32_t k = 0; k < kBlock * kBlock; ++k) {
                const uint32_t px = uint32_t(bx) + ((k & 1) | (k >> 1 & 2));
                const uint32_t py = uint32_t(by) + ((k >> 1 & 1) | (k >> 2 & 2));
                if (px >= uint32_t(w) || py >= uint32_t(h)) continue;
                x[i] = px, y[i++] = py;
            }
}

PixelSet TileOrder::pixels(const Tile& tile) {
    return {tile.pixels(), uint32_t(tile.x0), uint32_t(tile.y0),
            x.data(),      y.data(),          {scramble[0].data(), scramble[1].data()}};
}

PixelView pixel_view(const Camera& camera, bool spreads) {
    PixelView view{};
    view.without_spread = !spreads;
    view.orthographic = camera.orthographic;
    // Where planes cut rays, each ray gets its range anew.
    view.clip = camera.clip || camera.plane_count > 0;
    view.znear = camera.clip ? camera.znear : 0;
    view.zfar = camera.clip ? camera.zfar : std::numeric_limits<double>::infinity();
    view.centre_x = camera.axis.x;
    view.centre_y = camera.axis.y;
    for (int c = 0; c < 3; ++c) {
        view.eye[c] = camera.eye[c];
        view.forward[c] = camera.forward[c];
        view.dx[c] = camera.raster_dx[c];
        view.dy[c] = camera.raster_dy[c];
        view.dx_square += view.dx[c] * view.dx[c];
        view.dy_square += view.dy[c] * view.dy[c];
    }
    return view;
}

void TileJob::run(const Tile& tile) {
    StageScope stage(Stage::Film);
    tile_ = tile;
    begin_tile();
    const int per_chunk = std::max(1, int(settings_.chunk_rays / tile.pixels()));
    for (int first = 0; first < settings_.samples_per_pixel && !shading_.stopped();
         first += per_chunk) {
        make_rays(first, std::min(settings_.samples_per_pixel, first + per_chunk));
        follow_layers();
        finish_samples();
    }
    planes_.finish();
    write_tile();
    shading_.end_tile(thread_);
}

vec4 TileJob::run_sample(const Tile& tile, int sample) {
    tile_ = tile;
    begin_tile();
    make_rays(sample, sample + 1);
    follow_layers();
    shading_.end_tile(thread_);
    vec3 color(m_.color[0][0], m_.color[1][0], m_.color[2][0]);
    float through = (m_.through[0][0] + m_.through[1][0] + m_.through[2][0]) / 3;
    float held = shading_.has_mattes() ? float(m_.held[0] + m_.held[1] + m_.held[2]) / 3 : 0;
    return vec4(color, 1 - through - held);
}

void TileJob::begin_tile() {
    std::fill_n(m_.sum.begin(), 4 * tile_.pixels(), 0.0);
    if (shading_.has_mattes()) std::fill_n(m_.held.begin(), 3 * tile_.pixels(), 0.0);
    m_.order.set_size(tile_.x1 - tile_.x0, tile_.y1 - tile_.y0);
    planes_.begin(m_.order.pixels(tile_));
    if (settings_.samples_per_pixel > 1) kernels_.scrambles(m_.order.pixels(tile_), settings_.seed);
}

// What all rays of the camera share, in the rays [begin, end).
void TileJob::begin_rays(size_t begin, size_t end) {
    RayBatch& r = m_.rays;
    auto set = [&](auto* column, auto value) { std::fill(column + begin, column + end, value); };
    for (int c = 0; c < 3; ++c) {
        set(r.org[c], float(camera_.eye[c]));
        set(r.first_org[c], float(camera_.eye[c]));
        set(r.dOdx[c], camera_.orthographic ? float(camera_.raster_dx[c]) : 0.0f);
        set(r.dOdy[c], camera_.orthographic ? float(camera_.raster_dy[c]) : 0.0f);
        set(r.dDdx[c], 0.0f);
        set(r.dDdy[c], 0.0f);
    }
    set(r.tnear, 0.0f);
    set(r.tfar, std::numeric_limits<float>::infinity());
    for (float* column : {r.time, r.t_passed}) set(column, 0.0f);
    set(r.sees, ~0u);
    for (float* column : {r.share, r.allowance, r.weight}) set(column, 1.0f);
    for (uint32_t* column : {r.layer, r.medium, r.turns, r.spent}) set(column, 0u);
    for (size_t k = begin; k < end; ++k) r.slot[k] = uint32_t(k);
}

// Rays of filters that are no product of two: one at a time.
void TileJob::draw_from_grid() {
    RayBatch& r = m_.rays;
    for (size_t k = 0; k < r.count; ++k) {
        const uint32_t x = r.pixel_x[k], y = r.pixel_y[k], sample = r.sample[k];
        const dvec2 at =
            dvec2(x + 0.5, y + 0.5) +
            settings_.filter_grid->offset(int(sample), settings_.samples_per_pixel,
                                          stratified_sample(sample, hash(x, y, settings_.seed)));
        const CameraRay ray = camera_ray(camera_, at.x, at.y);
        set_triple(r.org, k, ray.org);
        set_triple(r.first_org, k, ray.org);
        set_triple(r.dir, k, ray.dir);
        set_triple(r.dDdx, k, ray.ddir_dx);
        set_triple(r.dDdy, k, ray.ddir_dy);
        r.tnear[k] = ray.tnear;
        r.tfar[k] = ray.tfar;
    }
}

// What a sample counts for of its pixel.
double TileJob::weight_of(size_t slot) const {
    if (!has_grid()) return 1;
    const uint32_t sample = m_.samples[slot % m_.samples.size()].index;
    return settings_.filter_grid->weight(int(sample), settings_.samples_per_pixel);
}

// A pixel's weights have the sum of unweighted samples, so what lets the background through does,
// too.
void TileJob::weigh_samples() {
    for (size_t slot = 0; slot < tile_.pixels() * m_.samples.size(); ++slot) {
        const auto weight = float(weight_of(slot));
        for (size_t c = 0; c < 3; ++c) {
            m_.color[c][slot] *= weight;
            m_.through[c][slot] = 1 - weight * (1 - m_.through[c][slot]);
        }
    }
}

// Cuts each ray to its part behind the plane. A ray without such a part gets an empty range.
void TileJob::cut_rays(const dvec4& plane) {
    RayBatch& r = m_.rays;
    for (size_t k = 0; k < r.count; ++k) {
        double before = plane.w, per_t = 0;
        for (int c = 0; c < 3; ++c) {
            before += plane[c] * double(r.org[c][k]);
            per_t += plane[c] * double(r.dir[c][k]);
        }
        const double t = -before / per_t;
        if (per_t > 0 && t >= 0)
            r.tfar[k] = std::min(r.tfar[k], float(t));
        else if (per_t < 0)
            r.tnear[k] = std::max(r.tnear[k], float(t));
        else if (before > 0)
            r.tnear[k] = std::numeric_limits<float>::infinity();
    }
}

void TileJob::make_rays(int first_sample, int end_sample) {
    StageScope stage(Stage::Sample);
    RayBatch& r = m_.rays;
    const PixelSet pixels = m_.order.pixels(tile_);
    r.count = pixels.count * size_t(end_sample - first_sample);
    r.passing = false;
    r.spreads = !view_.without_spread;
    begin_rays(0, std::min(std::exchange(m_.passed, 0), m_.begun));
    if (m_.begun < r.count) begin_rays(std::exchange(m_.begun, r.count), r.count);
    PixelRays out{};
    out.tnear = r.tnear;
    out.tfar = r.tfar;
    out.pixel_x = r.pixel_x;
    out.pixel_y = r.pixel_y;
    out.sample = r.sample;
    for (int c = 0; c < 3; ++c) {
        out.org[c] = r.org[c];
        out.first_org[c] = r.first_org[c];
        out.dir[c] = r.dir[c];
        out.ddir_dx[c] = r.dDdx[c];
        out.ddir_dy[c] = r.dDdy[c];
    }
    const FilterTable* filter = settings_.samples_per_pixel > 1 ? filter_ : nullptr;
    m_.samples.clear();
    for (int sample = first_sample; sample < end_sample; ++sample)
        m_.samples.push_back(sample_bits(uint32_t(sample)));
    kernels_.rays(view_, pixels, m_.samples.data(), m_.samples.size(), filter, out);
    if (has_grid()) draw_from_grid();
    for (size_t p = 0; p < camera_.plane_count; ++p) cut_rays(camera_.planes[p]);
    for (int c = 0; c < 3; ++c) {
        std::fill_n(m_.color[c].begin(), r.count, 0.0f);
        std::fill_n(m_.through[c].begin(), r.count, 1.0f);
    }
}

// Each round traces the rays that still see through, and shades all their hits at once.
void TileJob::follow_layers() {
    for (int layer = 0; m_.rays.count > 0; ++layer) {
        const HitBatch& hits = trace(accel_, m_.rays, kMaskEye, 0, m_.hits, m_.counters.trace);
        if (shading_.miss_distance() > 0) shade_misses(hits);
        if (hits.count == 0) return;
        if (layer == settings_.max_layers) {  // what is left is not seen
            m_.counters.too_deep += hits.count;
            return;
        }
        shade(hits);
        if (shading_.has_mattes()) hold_out(hits);
        keep_planes(hits);
        composite(hits);
    }
}

// What lies along the rays that leave the scene ends them.
void TileJob::shade_misses(const HitBatch& hits) {
    const HitBatch& ends = missed(m_.rays, hits, shading_.miss_distance(), m_.misses);
    if (ends.count == 0) return;
    shade(ends, Ends::Nothing);
    for (size_t k = 0; k < ends.count; ++k) {
        if (planes_.has_light()) lay_light(plane_hit(ends, k), ends, k);
        lay_behind(ends, k);
    }
}

void TileJob::shade(const HitBatch& hits, Ends ends) {
    const size_t padded = (hits.count + kPacket - 1) / kPacket * kPacket;
    // What lies behind the hits is looked at, too, by mend().
    for (auto& v : m_.shaded) std::fill(v.begin() + hits.count, v.begin() + padded, 0.0f);
    for (auto& v : m_.shaded_aov) std::fill_n(v.begin(), padded, 0.0f);
    ShadeResult result{{m_.shaded[0].data(), m_.shaded[1].data(), m_.shaded[2].data()},
                       {m_.shaded[3].data(), m_.shaded[4].data(), m_.shaded[5].data()},
                       m_.aov_pointers,
                       m_.passages.data()};
    std::fill_n(m_.passages.begin(), hits.count, Passage{});
    StageScope stage(Stage::Gather);
    if (ends == Ends::Surfaces)
        shading_.shade(hits, thread_, result);
    else
        shading_.shade_misses(hits, thread_, result);
    m_.counters.shading_points += hits.count;
    mend(hits);
}

void TileJob::mend(const HitBatch& hits) {
    const float* shaded[6];
    for (size_t k = 0; k < 6; ++k) shaded[k] = m_.shaded[k].data();
    // Sixteen results, those behind the last included.
    auto all_finite = [&](size_t first) {
        return kernels_.finite(shaded, 6, first) &&
               kernels_.finite(m_.aov_pointers.data(), m_.aov_pointers.size(), first);
    };
    for (size_t first = 0; first < hits.count; first += kPacket) {
        if (all_finite(first)) continue;
        for (size_t k = first; k < std::min<size_t>(first + kPacket, hits.count); ++k) {
            if (mend_hit(k)) continue;
            ++m_.counters.non_finite;
            m_.counters.non_finite_geometry =
                std::min(m_.counters.non_finite_geometry, hits.geometry[k]);
        }
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

// The hit's share of the sample's coverage: its opacity times the transmission of the layers before
// it. Mattes have no coverage.
double TileJob::hidden_by(const HitBatch& hits, size_t k) const {
    if (shading_.has_mattes() && shading_.is_matte(hits, k)) return 0;
    const size_t slot = m_.rays.slot[hits.ray[k]];
    double hidden = 0;
    for (size_t c = 0; c < 3; ++c) {
        const double before = double(m_.through[c][slot]);
        const double passes = 1 - double(std::clamp(m_.shaded[3 + c][k], 0.0f, 1.0f));
        hidden += before * (1 - passes * double(m_.passages[k].onward)) / 3;
    }
    return hidden;
}

TilePlanes::Hit TileJob::plane_hit(const HitBatch& hits, size_t k) const {
    const size_t slot = m_.rays.slot[hits.ray[k]];
    return {k, pixel_of(slot), hits.sample[k], weight_of(slot)};
}

void TileJob::lay_light(const TilePlanes::Hit& hit, const HitBatch& hits, size_t k) {
    const size_t slot = m_.rays.slot[hits.ray[k]];
    const float through[3] = {m_.through[0][slot], m_.through[1][slot], m_.through[2][slot]};
    planes_.lay(hit, through, m_.aov_pointers);
}

void TileJob::keep_planes(const HitBatch& hits) {
    if (film_.aovs.empty()) return;
    for (size_t k = 0; k < hits.count; ++k) {
        const TilePlanes::Hit hit = plane_hit(hits, k);
        if (planes_.has_light()) lay_light(hit, hits, k);
        if (planes_.has_coverage()) planes_.cover(hit, hidden_by(hits, k), m_.aov_pointers);
        if (shows_first(hits, k)) planes_.keep(hit, m_.aov_pointers);
    }
}

// For the variance of the pixels, if a plane is to have it.
void TileJob::count_samples() {
    if (!planes_.has_variance()) return;
    for (size_t slot = 0; slot < tile_.pixels() * m_.samples.size(); ++slot) {
        vec3 color(m_.color[0][slot], m_.color[1][slot], m_.color[2][slot]);
        const vec3 through(m_.through[0][slot], m_.through[1][slot], m_.through[2][slot]);
        if (settings_.background) color += through * *settings_.background;
        planes_.count(pixel_of(slot), color);
    }
}

// What mattes hide is neither their colour nor coverage. Distances, places and ids stay theirs.
void TileJob::hold_out(const HitBatch& hits) {
    for (size_t k = 0; k < hits.count; ++k) {
        if (!shading_.is_matte(hits, k)) continue;
        const size_t slot = m_.rays.slot[hits.ray[k]];
        for (size_t c = 0; c < 3; ++c) {
            m_.shaded[c][k] = 0;
            m_.held[3 * pixel_of(slot) + c] +=
                weight_of(slot) *
                double(m_.through[c][slot] * std::clamp(m_.shaded[3 + c][k], 0.0f, 1.0f));
        }
        for (size_t plane = 0; plane < m_.shaded_aov.size(); ++plane)
            if (film_.aovs[plane].filter == AovFilter::Mean) m_.shaded_aov[plane][k] = 0;
    }
}

// What holes of the pixel show instead: the background, or no coverage.
vec4 TileJob::behind_mattes(size_t pixel) const {
    const double* held = &m_.held[3 * pixel];
    if (!settings_.background) return vec4(0, 0, 0, -(held[0] + held[1] + held[2]) / 3);
    const vec3& color = *settings_.background;
    return vec4(held[0] * double(color.x), held[1] * double(color.y), held[2] * double(color.z), 0);
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

// Lays sixteen hits from k on behind what is there; a bit for each whose ray goes on.
uint32_t TileJob::lay_sixteen(const HitBatch& hits, size_t k) {
    // Rays of the first layer stand at their slots.
    const size_t slot = hits.ray[k];
    const bool dense = !m_.rays.passing && k + kPacket <= hits.count &&
                       hits.ray[k + kPacket - 1] == slot + kPacket - 1;
    uint32_t going_on = 0;
    if (!dense) {
        for (size_t i = 0; i < std::min<size_t>(kPacket, hits.count - k); ++i) {
            lay_behind(hits, k + i);
            going_on |= uint32_t(passes(m_.rays.slot[hits.ray[k + i]])) << i;
        }
        return going_on;
    }
    LaidHits laid;
    float *color[3], *through[3];
    for (size_t c = 0; c < 3; ++c) {
        laid.Ci[c] = m_.shaded[c].data() + k;
        laid.Oi[c] = m_.shaded[3 + c].data() + k;
        color[c] = m_.color[c].data() + slot;
        through[c] = m_.through[c].data() + slot;
    }
    for (size_t i = 0; i < kPacket; ++i) laid.onward[i] = m_.passages[k + i].onward;
    return kernels_.lay(laid, 1.0f - settings_.opaque_above, color, through);
}

// Lays the hits behind what is there and keeps, in place, the rays that go on.
void TileJob::composite(const HitBatch& hits) {
    size_t going_on = 0;
    for (size_t first = 0; first < hits.count; first += kPacket)
        for (uint32_t left = lay_sixteen(hits, first); left; left &= left - 1) {
            const size_t k = first + size_t(std::countr_zero(left));
            const uint32_t medium = shading_.medium_behind(hits, k);
            pass_through(accel_, m_.rays, going_on, hits, k);
            m_.rays.turns[going_on] += m_.passages[k].turns;
            m_.rays.spent[going_on] += m_.passages[k].spent;
            m_.rays.allowance[going_on] *= m_.passages[k].kept;
            m_.rays.weight[going_on] = largest_through(m_.rays.slot[going_on]);
            m_.rays.medium[going_on++] = medium;
        }
    m_.passed = std::max(m_.passed, going_on);
    m_.rays.count = going_on;
    m_.rays.passing = true;
}

float TileJob::largest_through(size_t slot) const {
    return std::max({m_.through[0][slot], m_.through[1][slot], m_.through[2][slot]});
}

bool TileJob::passes(size_t slot) const {
    return largest_through(slot) > 1.0f - settings_.opaque_above;
}

void TileJob::finish_samples() {
    if (has_grid()) weigh_samples();
    const float *color[3], *through[3];
    for (int c = 0; c < 3; ++c) {
        color[c] = m_.color[c].data();
        through[c] = m_.through[c].data();
    }
    kernels_.add(tile_.pixels(), m_.samples.size(), color, through,
                 settings_.background ? &settings_.background->x : nullptr, m_.sum.data());
    count_samples();
}

void TileJob::write_tile() const {
    const double weight = 1.0 / settings_.samples_per_pixel;
    for (size_t pixel = 0; pixel < tile_.pixels(); ++pixel) {
        const int x = tile_.x0 + int(m_.order.x[pixel]);
        const int y = tile_.y0 - film_.top + int(m_.order.y[pixel]);
        vec4& out = film_.at(x, y);
        for (int c = 0; c < 4; ++c) out[c] = float(weight * m_.sum[4 * pixel + size_t(c)]);
        if (shading_.has_mattes()) out += float(weight) * behind_mattes(pixel);
        const size_t at = size_t(y) * size_t(film_.width) + size_t(x);
        for (size_t k = 0; k < film_.aovs.size(); ++k)
            film_.aovs[k].values[at] = planes_.value(k, pixel);
    }
}

}  // namespace kinora::raytrace
