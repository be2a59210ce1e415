// tests/bench/hand_surfaces_p.h: the hand-written shaders over a vector type V, which wraps one
// instruction set's intrinsics. Included by one .cpp an instruction set, each with its own flags;
// everything hangs on the class of V, so the two never share code.
#pragma once

#include <math.h>

#include <limits>

#include "jit/math/coefficients_p.h"
#include "jit/math/noise_p.h"
#include "tests/bench/hand_shaders.h"

namespace kinora::hand {

template <class V>
struct Hand {
    using F = typename V::F;
    using I = typename V::I;
    using M = typename V::M;
    struct F3 {
        F x, y, z;
    };

    // ---- vectors --------------------------------------------------------------------------------

    static F dot(const F3& a, const F3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    static F3 normalize(const F3& a) {
        F squared = dot(a, a);
        F inverse = V::where(V::less(V::set(0), squared), V::set(1) / V::sqrt(squared));
        return {a.x * inverse, a.y * inverse, a.z * inverse};
    }
    static F3 load(const float* const p[3], size_t i) {
        return {V::load(p[0] + i), V::load(p[1] + i), V::load(p[2] + i)};
    }
    static F3 to_object(const Inputs& in, const F3& p, size_t i) {
        auto row = [&](size_t r) {
            auto& m = in.object[r];
            return V::load(m[0] + i) * p.x + V::load(m[1] + i) * p.y + V::load(m[2] + i) * p.z +
                   V::load(m[3] + i);
        };
        return {row(0), row(1), row(2)};
    }
    static F3 faceforward(const F3& N, const F3& I_, const F3& Ng) {
        // The sign bit of -(I . Ng) goes to N, 0 counted as facing.
        M away = V::less(V::set(0), dot(I_, Ng));
        return {V::select(away, -N.x, N.x), V::select(away, -N.y, N.y), V::select(away, -N.z, N.z)};
    }

    // ---- functions ------------------------------------------------------------------------------

    static F clamp01(F x) { return V::min(V::max(x, V::set(0)), V::set(1)); }
    static F mix(F a, F b, F t) { return a + t * (b - a); }
    static F mix(float a, float b, F t) { return V::set(a) + t * V::set(b - a); }
    // Clamping alone gives 0 below and 1 above.
    static F smoothstep(float low, float high, F x) {
        F t = clamp01((x - V::set(low)) * V::set(1 / (high - low)));
        return t * t * (V::set(3) - (t + t));
    }
    template <size_t n>
    static F horner(F x, const float (&c)[n]) {
        F sum = V::set(c[n - 1]);
        for (size_t k = n - 1; k-- > 0;) sum = V::fma(sum, x, V::set(c[k]));
        return sum;
    }

    static constexpr float kMagic = 12582912.0f;  // 1.5 * 2^23: adding it rounds to an integer

    static F sin(F x) {
        using namespace jit::math;
        F t = V::fma(x, V::set(0.318309886f), V::set(kMagic));
        F minus_k = V::set(kMagic) - t;
        F r = V::fma(minus_k, V::set(kPi[0]), x);
        r = V::fma(minus_k, V::set(kPi[1]), r);
        r = V::fma(minus_k, V::set(kPi[2]), r);
        F z = r * r;
        F sine = V::fma(z * r, horner(z, kSinWide), r);
        sine = V::from_bits(V::bit_xor(V::bits(sine), V::template left<31>(V::bits(t))));
        M huge = V::less(V::set(8192), V::abs(x));
        if (V::any(huge)) [[unlikely]]
            return huge_sine(huge, x, sine);
        return sine;
    }
    [[gnu::noinline]] static F huge_sine(M huge, F x, F sine) {
        alignas(64) float in[V::kLanes], out[V::kLanes];
        V::store(in, x);
        V::store(out, sine);
        for (size_t k = 0; k < V::kLanes; ++k)
            if (V::which(huge) >> k & 1) out[k] = float(::sin(double(in[k])));
        return V::load(out);
    }

    // x^y for x >= 0, y > 0.
    static F power(F x, float y) {
        using namespace jit::math;
        const I root_half = V::seti(0x3f3504f3);
        I pattern =
            V::sub(V::bits(V::max(x, V::set(std::numeric_limits<float>::min()))), root_half);
        F f = V::from_bits(V::add(V::bit_and(pattern, V::seti(0x7fffff)), root_half)) - V::set(1);
        F e = V::to_float(V::template right_signed<23>(pattern));
        F log2 = V::fma(f, horner(f, kLog2Fast), e);
        F p = V::min(V::max(V::set(y) * log2, V::set(-126)), V::set(129));
        F t = p + V::set(kMagic + 126);
        F r = p + (V::set(kMagic + 126) - t);
        F two_r = V::fma(r, horner(r, kExp2Fast), V::set(1));
        F value = (two_r + two_r) * V::from_bits(V::template left<23>(V::bits(t)));
        return V::where(V::less(V::set(0), x), value);
    }

    // ---- noise ----------------------------------------------------------------------------------

    struct Axis {
        I key[2];
        F distance[2], weight;
    };
    static Axis axis(F coordinate, int multiplier) {
        const F limit = V::set(jit::math::kLatticeLimit);
        F x = V::min(V::max(coordinate, V::set(0) - limit), limit);
        F cell = V::floor(x);
        F t = x - cell;
        I lower = V::mul(V::truncate(cell), V::seti(multiplier));
        return {{lower, V::add(lower, V::seti(multiplier))},
                {t, t - V::set(1)},
                t * t * (t * (t * (t * V::set(6) - V::set(15)) + V::set(10)))};
    }
    static F corner(I hash, int gradient, F dx, F dy, F dz) {
        I g = V::mul(hash, V::bit_xor(hash, V::seti(gradient)));
        F sum = V::to_float(g) * dx;
        sum = V::fma(V::to_float(V::template left<jit::math::kGradientShift[1]>(g)), dy, sum);
        return V::fma(V::to_float(V::template left<jit::math::kGradientShift[2]>(g)), dz, sum);
    }
    struct Lattice {
        Axis x, y, z;
        I hash[8];
    };
    static Lattice lattice(const F3& p) {
        using namespace jit::math;
        Lattice l{axis(p.x, int(kLattice[0])),
                  axis(p.y, int(kLattice[1])),
                  axis(p.z, int(kLattice[2])),
                  {}};
        for (size_t c = 0; c < 8; ++c)
            l.hash[c] =
                V::bit_xor(V::bit_xor(V::bit_xor(l.z.key[c >> 2], V::seti(int(kLatticeSeed))),
                                      l.y.key[c >> 1 & 1]),
                           l.x.key[c & 1]);
        return l;
    }
    static F component(const Lattice& l, size_t k) {
        F v[8];
        for (size_t c = 0; c < 8; ++c)
            v[c] = corner(l.hash[c], int(jit::math::kGradient[k]), l.x.distance[c & 1],
                          l.y.distance[c >> 1 & 1], l.z.distance[c >> 2]);
        F sum = mix(mix(mix(v[0], v[1], l.x.weight), mix(v[2], v[3], l.x.weight), l.y.weight),
                    mix(mix(v[4], v[5], l.x.weight), mix(v[6], v[7], l.x.weight), l.y.weight),
                    l.z.weight);
        constexpr float scale = jit::math::kNoiseScale[2] * 0x1p-32f;
        return clamp01(V::fma(sum, V::set(scale), V::set(0.5f)));
    }
    static F noise(const F3& p) { return component(lattice(p), 0); }
    static F3 noise3(const F3& p) {
        Lattice l = lattice(p);
        return {component(l, 0), component(l, 1), component(l, 2)};
    }
    static F cellnoise(F x) {
        using namespace jit::math;
        I h = V::mul(V::bit_xor(V::truncate(V::floor(x)), V::seti(int(kKeySeed))),
                     V::seti(int(kKeyMultiplier)));
        h = V::bit_xor(h, V::template right<15>(h));
        for (uint32_t multiplier : kRoundMultiplier)
            h = V::mul(V::bit_xor(h, V::template right<16>(h)), V::seti(int(multiplier)));
        h = V::bit_xor(h, V::template right<16>(h));
        return V::to_float(V::template right<8>(h)) * V::set(0x1p-24f);
    }

    // ---- lights ---------------------------------------------------------------------------------

    static void fill(float* to, float value, size_t count) {
        for (size_t i = 0; i < count; i += V::kLanes) V::store(to + i, V::set(value));
    }
    static void solar(const Light& light, const Record& record, size_t count) {
        for (int k = 0; k < 3; ++k) {
            fill(record.L[k], -light.axis[k], count);
            fill(record.Cl[k], light.color[k], count);
        }
    }
    static void ambient(const Light& light, const Record& record, size_t count) {
        for (int k = 0; k < 3; ++k) fill(record.Cl[k], light.color[k], count);
    }

    // What all lights give a point: the loop every surface here ends with.
    struct Lighting {
        F3 ambient, diffuse, specular;
    };
    static Lighting lighting(const Record* records, size_t record_count, size_t i, const F3& Nf,
                             const F3& view, float exponent) {
        const F zero = V::set(0);
        Lighting sum{{zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}};
        for (const Record* r = records; r < records + record_count; ++r) {
            F3 Cl = load(r->Cl, i);
            if (r->ambient) {
                sum.ambient = {sum.ambient.x + Cl.x, sum.ambient.y + Cl.y, sum.ambient.z + Cl.z};
                continue;
            }
            F3 L = normalize(load(r->L, i));
            F cosine = dot(L, Nf);
            F diffuse = V::max(cosine, zero) * V::set(1 - r->nondiffuse);
            F3 H = normalize({L.x + view.x, L.y + view.y, L.z + view.z});
            F specular = power(V::max(dot(H, Nf), zero), exponent) * V::set(1 - r->nonspecular);
            specular = V::where(V::less(zero, cosine), specular);
            add(sum.diffuse, Cl, diffuse);
            add(sum.specular, Cl, specular);
        }
        return sum;
    }
    static void add(F3& sum, const F3& color, F amount) {
        sum = {sum.x + color.x * amount, sum.y + color.y * amount, sum.z + color.z * amount};
    }

    // ---- surfaces -------------------------------------------------------------------------------

    struct Point {
        F3 Nf, view;
    };
    static Point point(const Inputs& in, size_t i) {
        F3 incident = load(in.I, i);
        F3 Nf = faceforward(normalize(load(in.N, i)), incident, load(in.Ng, i));
        F3 V_ = normalize(incident);
        return {Nf, {-V_.x, -V_.y, -V_.z}};
    }
    static void store(const Outputs& out, size_t i, const F3& Ci) {
        V::store(out.Ci[0] + i, Ci.x);
        V::store(out.Ci[1] + i, Ci.y);
        V::store(out.Ci[2] + i, Ci.z);
        for (float* Oi : out.Oi) V::store(Oi + i, V::set(1));
    }
    // Ct (ambient + Kd diffuse) + Ks specular, component by component.
    static F3 coat(const F3& Ct, const Lighting& l, float Kd, F Ks_r, F Ks_g, F Ks_b) {
        return {Ct.x * (l.ambient.x + V::set(Kd) * l.diffuse.x) + Ks_r * l.specular.x,
                Ct.y * (l.ambient.y + V::set(Kd) * l.diffuse.y) + Ks_g * l.specular.y,
                Ct.z * (l.ambient.z + V::set(Kd) * l.diffuse.z) + Ks_b * l.specular.z};
    }

    static void plastic(const Inputs& in, const Outputs& out, const Record* records,
                        size_t record_count, size_t count) {
        for (size_t i = 0; i < count; i += V::kLanes) {
            Point p = point(in, i);
            Lighting l = lighting(records, record_count, i, p.Nf, p.view, 1 / 0.1f);
            const F one = V::set(1), Ks = V::set(0.5f);
            store(out, i, coat({one, one, one}, l, 0.5f, Ks, Ks, Ks));
        }
    }

    static void marble(const Inputs& in, const Outputs& out, const Record* records,
                       size_t record_count, size_t count) {
        for (size_t i = 0; i < count; i += V::kLanes) {
            Point p = point(in, i);
            F3 at = to_object(in, load(in.P, i), i);
            F turbulence = V::set(0);
            float weight = 1, frequency = 1;
            for (int octave = 0; octave < 6; ++octave) {
                F f = V::set(frequency);
                F n = noise({f * at.x, f * at.y, f * at.z});
                turbulence = turbulence + V::set(weight) * V::abs(V::set(2) * n - V::set(1));
                weight *= 0.5f;
                frequency *= 2;
            }
            F layer = V::set(1.6f) * (at.x + V::set(0.6f) * at.y) + V::set(5) * turbulence;
            F vein = V::set(0.5f) + V::set(0.5f) * sin(layer);
            vein = vein * vein;
            F fine = V::set(0.35f) * smoothstep(0.55f, 1.1f, turbulence);
            F low = smoothstep(0, 0.14f, vein), high = smoothstep(0.08f, 0.45f, vein);
            auto blend = [&](float veincolor, float midcolor, float bodycolor) {
                F color = mix(mix(veincolor, midcolor, low), V::set(bodycolor), high);
                return mix(color, V::set(midcolor), fine);
            };
            F3 Ct{blend(0.13f, 0.62f, 0.93f), blend(0.13f, 0.60f, 0.91f),
                  blend(0.19f, 0.60f, 0.87f)};
            Lighting l = lighting(records, record_count, i, p.Nf, p.view, 1 / 0.06f);
            const F Ks = V::set(0.4f);
            store(out, i, coat(Ct, l, 0.8f, Ks, Ks, Ks));
        }
    }

    static void wood(const Inputs& in, const Outputs& out, const Record* records,
                     size_t record_count, size_t count) {
        for (size_t i = 0; i < count; i += V::kLanes) {
            Point p = point(in, i);
            F3 at = to_object(in, load(in.P, i), i);
            const F k = V::set(0.7f), half = V::set(0.5f), wobble = V::set(0.35f);
            F3 n = noise3({k * at.x, k * at.y, k * at.z});
            F3 ring{at.x + wobble * (n.x - half), at.y + wobble * (n.y - half),
                    at.z + wobble * (n.z - half)};
            F r = V::sqrt(ring.x * ring.x + ring.y * ring.y) * V::set(8);
            const F swell = V::set(1.5f);
            r = r + V::set(0.3f) * noise({swell * ring.x, swell * ring.y, swell * ring.z});
            F year = V::floor(r), phase = r - year;
            F late = smoothstep(0.3f, 0.85f, phase) * (V::set(1) - smoothstep(0.92f, 1, phase));
            late = late * (V::set(0.6f) + V::set(0.4f) * cellnoise(year));
            const F fine = V::set(60);
            F3 fibre{at.x * fine, at.y * fine, at.z * fine * V::set(0.06f)};
            F grain = V::set(0.75f) + V::set(0.35f) * noise(fibre);
            const F finer = V::set(2.3f);
            F pores = V::set(0.4f) *
                      smoothstep(0.62f, 0.75f,
                                 noise({finer * fibre.x, finer * fibre.y, finer * fibre.z}));
            auto blend = [&](float lightwood, float darkwood) {
                return mix(mix(lightwood, darkwood, late) * grain, V::set(0.6f * darkwood), pores);
            };
            F3 Ct{blend(0.63f, 0.33f), blend(0.40f, 0.16f), blend(0.20f, 0.06f)};
            Lighting l = lighting(records, record_count, i, p.Nf, p.view, 1 / 0.15f);
            F Ks = V::set(0.25f) * (V::set(1) - V::set(0.6f) * late);
            store(out, i, coat(Ct, l, 0.85f, Ks, V::set(0.95f) * Ks, V::set(0.85f) * Ks));
        }
    }

    // The cubic of each piece of a Catmull-Rom ramp, highest power first: one table a coefficient.
    struct Ramp {
        static constexpr int kKnots = 8, kPieces = kKnots - 3;
        float table[3][4][8];
        constexpr explicit Ramp(const float (&knots)[kKnots][3]) : table{} {
            for (int c = 0; c < 3; ++c)
                for (int p = 0; p < kPieces; ++p) {
                    float a = knots[p][c], b = knots[p + 1][c];
                    float d = knots[p + 2][c], e = knots[p + 3][c];
                    table[c][0][p] = 0.5f * (-a + 3 * b - 3 * d + e);
                    table[c][1][p] = 0.5f * (2 * a - 5 * b + 4 * d - e);
                    table[c][2][p] = 0.5f * (d - a);
                    table[c][3][p] = b;
                }
        }
    };
    static F ramp(const float (&t)[4][8], I piece, F x) {
        F sum = V::lookup(t[0], piece);
        for (int k = 1; k < 4; ++k) sum = V::fma(sum, x, V::lookup(t[k], piece));
        return sum;
    }

    static void fbm_ramp(const Inputs& in, const Outputs& out, const Record*, size_t,
                         size_t count) {
        static constexpr Ramp kRamp({{0.01f, 0.02f, 0.06f},
                                     {0.02f, 0.05f, 0.16f},
                                     {0.08f, 0.20f, 0.38f},
                                     {0.30f, 0.47f, 0.52f},
                                     {0.72f, 0.66f, 0.48f},
                                     {0.87f, 0.79f, 0.62f},
                                     {0.95f, 0.93f, 0.88f},
                                     {1, 1, 1}});
        for (size_t i = 0; i < count; i += V::kLanes) {
            F3 at = to_object(in, load(in.P, i), i);
            const F start = V::set(1.5f), two = V::set(2);
            at = {start * at.x, start * at.y, start * at.z};
            F sum = V::set(0);
            float weight = 0.5f;
            for (int octave = 0; octave < 8; ++octave) {
                sum = sum + V::set(weight) * (two * noise(at) - V::set(1));
                weight *= 0.5f;
                at = {two * at.x, two * at.y, two * at.z};
            }
            F scaled = clamp01(V::set(0.5f) + V::set(0.8f) * sum) * V::set(Ramp::kPieces);
            F piece = V::min(V::floor(scaled), V::set(Ramp::kPieces - 1));
            F x = scaled - piece;
            I index = V::truncate(piece);
            store(out, i,
                  {ramp(kRamp.table[0], index, x), ramp(kRamp.table[1], index, x),
                   ramp(kRamp.table[2], index, x)});
        }
    }

    static constexpr Shaders kShaders = {solar, ambient, plastic, marble, wood, fbm_ramp};
};

}  // namespace kinora::hand
