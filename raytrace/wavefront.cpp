// raytrace/wavefront.cpp: packs rays into packets and hits into dense batches.
#include "raytrace/wavefront.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>

#include "raytrace/points/points.h"
#include "runtime/base/check.h"
#include "runtime/base/memory/pages.h"
#include "runtime/base/stage_clock.h"

namespace kinora::raytrace {

namespace {

constexpr size_t kAlign = 64;

size_t round_up(size_t n, size_t step) {
    return (n + step - 1) / step * step;
}

// Hands out 64-byte aligned arrays of `length` 4-byte values from one block. One cache line lies
// between neighbours: arrays a power of two apart would all fall into the same few cache sets
// (measured: 160 ns a camera ray instead of 33).
class Carver {
  public:
    explicit Carver(size_t length) : bytes_(round_up(length, kPacket) * 4) {}
    template <class T>
    void operator()(T*& array) {
        static_assert(sizeof(T) == 4);
        array = base_
                    ? const_cast<std::remove_const_t<T>*>(reinterpret_cast<const T*>(base_ + used_))
                    : nullptr;
        used_ += bytes_ + kAlign;
    }
    template <class T, size_t N>
    void operator()(T* (&arrays)[N]) {
        for (T*& a : arrays) (*this)(a);
    }
    size_t total() const { return used_; }
    // Starts again over real memory, zeroed.
    void back(ZeroedVector<std::byte>& memory) {
        memory = ZeroedVector<std::byte>(used_ + kAlign);
        provide_pages(memory.data(), memory.size());
        auto address = reinterpret_cast<uintptr_t>(memory.data());
        base_ = memory.data() + (round_up(address, kAlign) - address);
        used_ = 0;
    }

  private:
    size_t bytes_;
    size_t used_ = 0;
    std::byte* base_ = nullptr;
};

void carve(RayBatch& b, Carver& carver) {
    carver(b.org), carver(b.dir), carver(b.tnear), carver(b.tfar), carver(b.time), carver(b.sees);
    carver(b.dOdx), carver(b.dOdy), carver(b.dDdx), carver(b.dDdy);
    carver(b.window), carver(b.passed_first), carver(b.passed_last);
    carver(b.t_passed), carver(b.first_org);
    carver(b.pixel_x), carver(b.pixel_y), carver(b.sample), carver(b.layer), carver(b.medium);
    carver(b.share), carver(b.allowance), carver(b.weight), carver(b.turns), carver(b.spent);
    carver(b.slot);
}

void carve(HitBatch& b, Carver& carver) {
    carver(b.geometry), carver(b.instance), carver(b.primitive), carver(b.u), carver(b.v);
    carver(b.t), carver(b.org), carver(b.dir), carver(b.P), carver(b.P_error), carver(b.Ng);
    carver(b.dPdx), carver(b.dPdy), carver(b.dDdx), carver(b.dDdy), carver(b.time);
    carver(b.pixel_x), carver(b.pixel_y), carver(b.sample), carver(b.layer), carver(b.ray);
    carver(b.beside);
}

template <class Batch>
void allocate(Batch& batch, size_t capacity, ZeroedVector<std::byte>& memory) {
    Carver carver(capacity);
    carve(batch, carver);
    carver.back(memory);
    carve(batch, carver);
}

// The store's arrays are ours; the batch shows them as const.
template <class T>
T* own(const T* p) {
    return const_cast<T*>(p);
}

void load_packet(const RayBatch& rays, size_t first, uint32_t mask, RayPacket16& packet) {
    const size_t bytes = sizeof(float) * kPacket;  // readable past count: capacity is padded
    std::memcpy(packet.org_x, rays.org[0] + first, bytes);
    std::memcpy(packet.org_y, rays.org[1] + first, bytes);
    std::memcpy(packet.org_z, rays.org[2] + first, bytes);
    std::memcpy(packet.dir_x, rays.dir[0] + first, bytes);
    std::memcpy(packet.dir_y, rays.dir[1] + first, bytes);
    std::memcpy(packet.dir_z, rays.dir[2] + first, bytes);
    std::memcpy(packet.tnear, rays.tnear + first, bytes);
    std::memcpy(packet.tfar, rays.tfar + first, bytes);
    for (size_t i = 0; i < size_t(kPacket); ++i) packet.mask[i] = rays.sees[first + i] & mask;
    packet.passing = rays.passing;
    if (rays.passing) {
        std::memcpy(packet.window, rays.window + first, bytes);
        std::memcpy(packet.passed_first, rays.passed_first + first, bytes);
        std::memcpy(packet.passed_last, rays.passed_last + first, bytes);
    }
    const size_t left = rays.count - first;
    packet.active = left >= kPacket ? 0xffffu : (1u << left) - 1;
}

// The columns of hits that are those of their rays, from one to the other.
class RayColumns {
  public:
    RayColumns(const RayBatch& rays, const HitBatch& hits) {
        add(rays.first_org, hits.org), add(rays.dir, hits.dir);
        add(rays.time, hits.time);
        add(rays.pixel_x, hits.pixel_x), add(rays.pixel_y, hits.pixel_y);
        add(rays.sample, hits.sample), add(rays.layer, hits.layer);
        if (rays.spreads) add(rays.dDdx, hits.dDdx), add(rays.dDdy, hits.dDdy);
    }
    // Appends the rays of `lanes`, of the sixteen from `first` on, to the hits; the batch counts on
    // when all is there.
    void append(size_t first, uint32_t lanes, HitBatch& out) const {
        point_kernels().keep(lanes, columns_, count_, first, out.count);
        uint32_t* ray = own(out.ray) + out.count;
        for (uint32_t left = lanes; left; left &= left - 1)
            *ray++ = uint32_t(first) + uint32_t(std::countr_zero(left));
        out.count += size_t(std::popcount(lanes));
    }

  private:
    template <class T>
    void add(const T* from, const T* to) {
        columns_[count_++] = {from, own(to)};
    }
    void add(const float* const (&from)[3], const float* const (&to)[3]) {
        for (int c = 0; c < 3; ++c) add(from[c], to[c]);
    }
    KeptColumn columns_[kMostKept];
    size_t count_ = 0;
};

// What the packet's lanes have met, to where the hits end.
void append_hits(const HitPacket16& hits, uint32_t lanes, const HitBatch& out) {
    const KeptColumn columns[] = {{hits.geometry, own(out.geometry)},
                                  {hits.instance, own(out.instance)},
                                  {hits.primitive, own(out.primitive)},
                                  {hits.u, own(out.u)},
                                  {hits.v, own(out.v)},
                                  {hits.t, own(out.t)}};
    point_kernels().keep(lanes, columns, std::size(columns), 0, out.count);
}

constexpr float kLeastCosine = 0.01f;

// Reads columns of rays at up to sixteen hits. Hits come in the order of their rays: where none of
// the rays has missed they lie as the hits do.
class BlockOfHits {
  public:
    BlockOfHits(const uint32_t* ray, size_t count)
        : ray_(ray), count_(count), dense_(count == kPacket && ray[kPacket - 1] - ray[0] == 15) {}

    template <class T>
    const T* at(const T* column, T (&scratch)[kPacket]) const {
        if (dense_) return column + ray_[0];
        for (size_t i = 0; i < kPacket; ++i) scratch[i] = column[ray_[i < count_ ? i : 0]];
        return scratch;
    }

  private:
    const uint32_t* ray_;
    size_t count_;
    bool dense_;
};

void footprint(const BlockOfHits& block, const HitBatch& hits, size_t first, float* const dO[3],
               const float* const dD[3], const float* const dP[3]) {
    float scratch[3][kPacket];
    FootprintRays rays;
    float* to[3];
    for (int c = 0; c < 3; ++c) {
        rays.dO[c] = block.at<float>(dO[c], scratch[c]);
        rays.dD[c] = dD[c] + first;
        rays.dir[c] = hits.dir[c] + first;
        rays.Ng[c] = hits.Ng[c] + first;
        to[c] = own(dP[c]) + first;
    }
    rays.t = hits.t + first;
    point_kernels().footprint(rays, kLeastCosine, to);
}

// Distances of rays that go on behind hits, from where they began.
void count_on(const RayBatch& rays, const HitBatch& hits) {
    std::fill_n(own(hits.beside), hits.count, 0u);
    if (!rays.passing) return;
    for (size_t k = 0; k < hits.count; ++k) {
        const uint32_t ray = hits.ray[k];
        float& t = own(hits.t)[k];
        own(hits.beside)[k] = t <= rays.window[ray];
        t += rays.t_passed[ray];
    }
}

// In blocks of sixteen; what is written behind the last hit is padding.
void find_footprints(const RayBatch& rays, const HitBatch& hits) {
    static_assert(kPacket == kPoints);
    for (size_t first = 0; first < hits.count; first += kPacket) {
        const BlockOfHits block(hits.ray + first, std::min<size_t>(hits.count - first, kPacket));
        footprint(block, hits, first, rays.dOdx, hits.dDdx, hits.dPdx);
        footprint(block, hits, first, rays.dOdy, hits.dDdy, hits.dPdy);
    }
}

// Padding repeats the last hit, so that whole vectors may be read (and shaded) at the end.
template <class T>
void pad(const T* array, size_t count) {
    if (count > 0)
        std::fill(own(array) + count, own(array) + round_up(count, kPacket), array[count - 1]);
}

void pad_all(const HitBatch& b) {
    auto pad3 = [&](const float* const(&a)[3]) {
        for (const float* array : a) pad(array, b.count);
    };
    pad(b.geometry, b.count), pad(b.instance, b.count), pad(b.primitive, b.count);
    pad(b.u, b.count), pad(b.v, b.count), pad(b.t, b.count), pad(b.time, b.count);
    pad3(b.org), pad3(b.dir), pad3(b.P), pad3(b.P_error), pad3(b.Ng);
    if (b.rays->spreads) pad3(b.dPdx), pad3(b.dPdy), pad3(b.dDdx), pad3(b.dDdy);
    pad(b.pixel_x, b.count), pad(b.pixel_y, b.count), pad(b.sample, b.count);
    pad(b.layer, b.count), pad(b.ray, b.count), pad(b.beside, b.count);
}

}  // namespace

void RayBatch::reserve(size_t capacity) {
    if (capacity <= capacity_) return;
    CHECK_EQ(count, 0u);
    allocate(*this, capacity, memory_);
    std::fill_n(sees, round_up(capacity, kPacket), ~0u);
    capacity_ = capacity;
}

void HitStore::reserve(size_t capacity) {
    if (capacity <= capacity_) return;
    allocate(batch_, capacity, memory_);
    capacity_ = capacity;
}

const HitBatch& trace(const Accel& accel, const RayBatch& rays, uint32_t mask, uint32_t depth,
                      HitStore& store, TraceCounters& counters) {
    store.reserve(rays.count);
    HitBatch& out = store.batch_;
    out.count = 0;
    out.depth = depth;
    out.rays = &rays;
    {
        StageScope stage(Stage::Trace);
        const RayColumns columns(rays, out);
        RayPacket16 packet;
        HitPacket16 hits;
        packet.coherent = depth == 0;
        packet.normals = false;  // surface_points() finds them
        for (size_t first = 0; first < rays.count; first += kPacket) {
            load_packet(rays, first, mask, packet);
            const uint32_t lanes = accel.intersect16(packet, hits, counters);
            if (lanes == 0) continue;
            append_hits(hits, lanes, out);
            columns.append(first, lanes, out);
        }
    }
    StageScope stage(Stage::Points);
    accel.surface_points(out.count, out.instance, out.primitive, out.u, out.v,
                         {{own(out.P[0]), own(out.P[1]), own(out.P[2])},
                          {own(out.P_error[0]), own(out.P_error[1]), own(out.P_error[2])},
                          {own(out.Ng[0]), own(out.Ng[1]), own(out.Ng[2])}});
    count_on(rays, out);
    if (rays.spreads) find_footprints(rays, out);
    pad_all(out);
    return out;
}

namespace {

// The end of a ray that meets nothing as hit k.
void put_end(const RayBatch& rays, float distance, size_t k, const HitBatch& out) {
    const uint32_t ray = out.ray[k];
    own(out.geometry)[k] = own(out.instance)[k] = own(out.primitive)[k] = kNone;
    own(out.u)[k] = own(out.v)[k] = 0;
    float square = 0;
    for (int c = 0; c < 3; ++c) square += rays.dir[c][ray] * rays.dir[c][ray];
    // The camera's end is a plane, farther away along rays at the picture's corners.
    const bool to_plane = out.depth == 0 && std::isfinite(rays.tfar[ray]);
    const float t =
        to_plane ? rays.tfar[ray] : std::min(rays.tfar[ray], distance / std::sqrt(square));
    own(out.t)[k] = t;
    for (int c = 0; c < 3; ++c) {
        const float P = rays.org[c][ray] + t * rays.dir[c][ray];
        own(out.P[c])[k] = P;
        own(out.P_error[c])[k] = std::abs(P) * 1e-6f;
        own(out.Ng[c])[k] = 0;
    }
}

}  // namespace

const HitBatch& missed(const RayBatch& rays, const HitBatch& hits, float distance,
                       HitStore& store) {
    store.reserve(rays.count);
    HitBatch& out = store.batch_;
    out.count = 0;
    out.depth = hits.depth;
    out.rays = &rays;
    const RayColumns columns(rays, out);
    size_t next_hit = 0;  // hits come in the order of their rays
    for (size_t first = 0; first < rays.count; first += kPacket) {
        const size_t end = std::min(rays.count, first + kPacket);
        uint32_t lanes = (1u << (end - first)) - 1;
        for (; next_hit < hits.count && hits.ray[next_hit] < end; ++next_hit)
            lanes &= ~(1u << (hits.ray[next_hit] - first));
        if (lanes != 0) columns.append(first, lanes, out);
    }
    for (size_t k = 0; k < out.count; ++k) put_end(rays, distance, k, out);
    count_on(rays, out);
    if (rays.spreads) find_footprints(rays, out);
    pad_all(out);
    return out;
}

namespace {

// How far before a hit a ray starts anew so as to meet its plane again for certain: 1.5 times what
// the hit's error box (or, in planes through 0, the floats around it) has across the plane.
float step_back(const HitBatch& hits, size_t k) {
    float box = 0, cosine = 0, square = 0, largest = 0;
    for (int c = 0; c < 3; ++c) {
        box += std::abs(hits.Ng[c][k]) * hits.P_error[c][k];
        cosine += hits.Ng[c][k] * hits.dir[c][k];
        square += hits.dir[c][k] * hits.dir[c][k];
        largest = std::max(largest, std::abs(hits.P[c][k]));
    }
    const float length = std::sqrt(square);
    if (cosine == 0) cosine = length;  // a triangle without area
    box = std::max({box, largest * 0x1p-22f, hits.t[k] * length * 0x1p-24f});
    return 1.5f * box / std::max(std::abs(cosine), 1e-4f * length);
}

}  // namespace

void move_ray(RayBatch& r, size_t to, size_t from) {
    if (to == from) return;
    auto move = [&](auto* column) { column[to] = column[from]; };
    auto move3 = [&](float* const(&columns)[3]) {
        for (float* column : columns) move(column);
    };
    move3(r.org), move3(r.dir), move3(r.dOdx), move3(r.dOdy), move3(r.dDdx), move3(r.dDdy);
    move3(r.first_org);
    move(r.tnear), move(r.tfar), move(r.time), move(r.sees), move(r.t_passed), move(r.window);
    move(r.passed_first), move(r.passed_last);
    move(r.pixel_x), move(r.pixel_y), move(r.sample), move(r.share), move(r.medium), move(r.slot);
    move(r.allowance), move(r.weight), move(r.turns), move(r.spent), move(r.layer);
}

void pass_through(const Accel& accel, RayBatch& r, size_t to, const HitBatch& hits, size_t k) {
    const size_t from = hits.ray[k];
    move_ray(r, to, from);
    r.layer[to] = hits.layer[k] + 1;
    const uint32_t body = accel.body(hits.instance[k]);
    if (hits.beside[k]) {  // one more at the same point
        r.passed_last[to] = body;
        return;
    }
    const vec3 P{hits.P[0][k], hits.P[1][k], hits.P[2][k]};
    const vec3 dir{r.dir[0][to], r.dir[1][to], r.dir[2][to]};
    const bool ordered = accel.policy().fixed_winner;
    const float back = ordered ? step_back(hits, k) : 0;
    const vec3 org =
        ordered ? P - back * dir
                : offset_ray_origin(P, {hits.P_error[0][k], hits.P_error[1][k], hits.P_error[2][k]},
                                    {hits.Ng[0][k], hits.Ng[1][k], hits.Ng[2][k]}, dir);
    for (int c = 0; c < 3; ++c) r.org[c][to] = org[c];
    r.tnear[to] = 0;
    r.tfar[to] -= hits.t[k] - r.t_passed[to] - back;
    r.t_passed[to] = hits.t[k] - back;
    r.window[to] = ordered ? 2 * back : -1;
    r.passed_first[to] = body;
    r.passed_last[to] = kNone;
}

void occluded(const Accel& accel, const RayBatch& rays, uint32_t mask, uint8_t* blocked,
              TraceCounters& counters) {
    RayPacket16 packet;
    for (size_t first = 0; first < rays.count; first += kPacket) {
        load_packet(rays, first, mask, packet);
        const uint32_t lanes = accel.occluded16(packet, counters);
        const size_t end = std::min(rays.count - first, size_t(kPacket));
        for (size_t i = 0; i < end; ++i) blocked[first + i] = lanes >> i & 1;
    }
}

void occluded(const Accel& accel, const RayBatch& rays, std::span<const uint32_t> which,
              uint32_t mask, uint8_t* blocked, TraceCounters& counters) {
    if (which.size() == rays.count) return occluded(accel, rays, mask, blocked, counters);
    RayPacket16 packet;
    const KeptColumn columns[] = {
        {rays.org[0], packet.org_x}, {rays.org[1], packet.org_y}, {rays.org[2], packet.org_z},
        {rays.dir[0], packet.dir_x}, {rays.dir[1], packet.dir_y}, {rays.dir[2], packet.dir_z},
        {rays.tnear, packet.tnear},  {rays.tfar, packet.tfar},    {rays.sees, packet.mask}};
    for (size_t first = 0; first < which.size(); first += kPacket) {
        const size_t end = std::min(which.size() - first, size_t(kPacket));
        uint32_t rows[kPacket];
        for (size_t i = 0; i < kPacket; ++i) rows[i] = which[first + std::min(i, end - 1)];
        point_kernels().pick(rows, columns, std::size(columns));
        for (uint32_t& sees : packet.mask) sees &= mask;
        packet.active = end == kPacket ? 0xffffu : (1u << end) - 1;
        const uint32_t lanes = accel.occluded16(packet, counters);
        for (size_t i = 0; i < end; ++i) blocked[first + i] = lanes >> i & 1;
    }
}

}  // namespace kinora::raytrace
