#!/usr/bin/env python3
"""Makes jit/math/coefficients_p.h: the minimax polynomials of jit/math (Remez exchange in mpmath).

Each row fits g(x) on [lo, hi] by sum c_k x^k in the sense of the weighted error w(x) |p - g|. The
coefficients are rounded to float one after the other, lowest power first; after each rounding the
rest is fitted again, so that later coefficients repair what rounding the earlier ones cost. Where
0 lies inside the interval the rest is no Chebyshev system any more, and all are rounded at once.

Usage: python3 scripts/math_coefficients.py > jit/math/coefficients_p.h
"""
import struct
from mpmath import mp, mpf, matrix, lu_solve, sin, cos, tan, exp, log, sqrt, atan, asin, pi

mp.dps = 40


def to_float(x):
    return mpf(struct.unpack("f", struct.pack("f", float(x)))[0])


def remez(g, w, lo, hi, powers):
    """The coefficients for `powers`, and the largest weighted error."""
    n = len(powers)
    grid = [lo + (hi - lo) * (1 - cos(pi * i / 400)) / 2 for i in range(401)]
    values = [(x, g(x), w(x)) for x in grid]
    nodes = [values[round(400 * i / n)] for i in range(n + 1)]
    for _ in range(12):
        a = matrix(n + 1, n + 1)
        b = matrix(n + 1, 1)
        for i, (x, gx, wx) in enumerate(nodes):
            for j, k in enumerate(powers):
                a[i, j] = x**k
            a[i, n] = (-1) ** i / wx
            b[i] = gx
        try:
            solution = lu_solve(a, b)
        except ZeroDivisionError:
            break
        c = [solution[j] for j in range(n)]
        errors = [(wx * (sum(cj * x**k for cj, k in zip(c, powers)) - gx), node)
                  for node in values for x, gx, wx in [node]]
        # One extremum from each run of equal signs, then the n + 1 neighbours with the largest.
        peaks = []
        for error, node in errors:
            if peaks and (peaks[-1][0] > 0) == (error > 0):
                if abs(error) > abs(peaks[-1][0]):
                    peaks[-1] = (error, node)
            else:
                peaks.append((error, node))
        while len(peaks) > n + 1:
            peaks.pop(0 if abs(peaks[0][0]) < abs(peaks[-1][0]) else -1)
        if len(peaks) < n + 1:
            break
        worst = max(abs(e) for e, _ in peaks)
        nodes = [node for _, node in peaks]
        if worst - min(abs(e) for e, _ in peaks) < worst / 1000:
            break
    return c, max(abs(e) for e, _ in errors)


def fit(g, w, lo, hi, count):
    """`count` float coefficients of powers 0 .. count-1 and their largest weighted error."""
    fixed = []
    if lo < 0:
        fixed = [to_float(c) for c in remez(g, w, lo, hi, list(range(count)))[0]]
    for k in range(len(fixed), count):
        rest = lambda x: g(x) - sum(c * x**j for j, c in enumerate(fixed))
        c, _ = remez(rest, w, lo, hi, list(range(k, count)))
        fixed.append(to_float(c[0]))
    error = max(abs(w(x) * (sum(c * x**j for j, c in enumerate(fixed)) - g(x)))
                for i in range(801) for x in [lo + (hi - lo) * mpf(i) / 800])
    return fixed, error


def parts(value, count, bits=None):
    """value as a sum of `count` floats; each but the last is cut to `bits[i]` bits if given."""
    out = []
    for i in range(count):
        part = to_float(value)
        if bits and i < len(bits):
            scale = mpf(2) ** (bits[i] - 1 - mp.floor(mp.log(abs(value), 2)))
            part = mp.nint(value * scale) / scale
        out.append(part)
        value -= part
    return out


TINY = mpf(10) ** -12  # instead of 0, where g has a removable singularity
PI4, PI2 = (pi / 4 * mpf("1.0005")) ** 2, (pi / 2 * mpf("1.0005")) ** 2
F0, F1 = sqrt(mpf(0.5)) - 1, sqrt(mpf(2)) - 1
H = log(2) / 2 * mpf("1.001")
off0 = lambda x: x if abs(x) > TINY else TINY


def odd(f, scale=1):
    """g(z) with f(x) = scale x (1 + z g(z)), z = x^2, and the weight of f's relative error."""
    def g(z):
        x = sqrt(off0(z))
        return (f(x) / (scale * x) - 1) / off0(z)
    def w(z):
        x = sqrt(off0(z))
        return off0(z) * scale * x / f(x)
    return g, w


def tail(f, head, power, relative):
    """g(x) with f(x) = head(x) + x^power g(x); weight of the error relative to relative(x)."""
    def g(x):
        x = off0(x)
        return (f(x) - head(x)) / x**power
    def w(x):
        x = off0(x)
        return abs(x**power / relative(x))
    return g, w


LOG2E = 1 / log(2)
log1p = lambda f: log(1 + f)
FITS = [
    # name, comment, (g, w), lo, hi, count
    ("kSin", "sin r = r + r z p(z), |r| <= pi/4", odd(sin), TINY, PI4, 3),
    ("kCos", "cos r = 1 - z/2 + z^2 p(z), |r| <= pi/4",
     tail(lambda z: cos(sqrt(z)), lambda z: 1 - z / 2, 2, lambda z: cos(sqrt(z))), TINY, PI4, 3),
    ("kSinWide", "sin r = r + r z p(z), |r| <= pi/2", odd(sin), TINY, PI2, 4),
    ("kTan", "tan r = r + r z p(z), |r| <= pi/4", odd(tan), TINY, PI4, 6),
    ("kExp", "e^r = 1 + r + r^2 p(r), |r| <= ln 2 / 2", tail(exp, lambda r: 1 + r, 2, exp), -H, H, 5),
    ("kExpFast", "e^r = 1 + r p(r), |r| <= ln 2 / 2", tail(exp, lambda r: 1, 1, exp), -H, H, 5),
    ("kExp2", "2^r = 1 + r ln 2 + r^2 p(r), |r| <= 1/2",
     tail(lambda r: mpf(2)**r, lambda r: 1 + r * log(2), 2, lambda r: mpf(2)**r),
     mpf("-0.501"), mpf("0.501"), 5),
    ("kExp2Fast", "2^r = 1 + r p(r), |r| <= 1/2",
     tail(lambda r: mpf(2)**r, lambda r: 1, 1, lambda r: mpf(2)**r), mpf("-0.501"), mpf("0.501"), 5),
    ("kLog", "ln(1+f) = f - f^2/2 + f^3 p(f), sqrt(1/2) <= 1+f <= sqrt 2",
     tail(log1p, lambda f: f - f * f / 2, 3, log1p), F0, F1, 9),
    ("kLogFast", "ln(1+f) = f + f^2 p(f)", tail(log1p, lambda f: f, 2, log1p), F0, F1, 8),
    ("kLog2Fast", "log2(1+f) = f p(f)",
     tail(lambda f: log1p(f) * LOG2E, lambda f: 0, 1, lambda f: log1p(f) * LOG2E), F0, F1, 9),
    ("kLog2Pow", "log2((1+s)/(1-s)) = 2/ln 2 (s + s^3/3 + s^5 p(s^2)), |s| <= 0.1716",
     (lambda z: (mp.atanh(sqrt(off0(z))) / sqrt(off0(z)) - 1 - off0(z) / 3) * 2 * LOG2E / off0(z)**2,
      lambda z: off0(z)**2), TINY, mpf("0.02945"), 4),
    ("kAtan", "atan q = q + q z p(z), |q| <= tan(pi/8)", odd(atan), TINY, mpf("0.1717"), 5),
    ("kAtanFast", "the same, shorter", odd(atan), TINY, mpf("0.1717"), 4),
    ("kAsin", "asin x = x + x z p(z), |x| <= 1/2", odd(asin), TINY, mpf("0.2501"), 6),
    ("kAsinFast", "the same, shorter", odd(asin), TINY, mpf("0.2501"), 5),
]
PARTS = [
    ("kPi", "pi", pi, 3, None),
    ("kHalfPi", "pi / 2", pi / 2, 3, None),
    ("kQuarterPi", "pi / 4; j times the first part is exact for j <= 4", pi / 4, 2, [21]),
    ("kLn2", "ln 2", log(2), 2, None),
    ("kLn2Short", "ln 2; e times the first part is exact for |e| < 256", log(2), 2, [16]),
    ("kLog2e", "1 / ln 2", LOG2E, 2, None),
    ("kTwoLog2e", "2 / ln 2", 2 * LOG2E, 2, None),
    ("kTwoThirdsLog2e", "2 / (3 ln 2)", 2 * LOG2E / 3, 2, None),
]


def literal(x):
    return f"{float(x):.9g}f".replace("f", ".0f", 1) if float(x) == int(x) else f"{float(x):.9g}f"


def array(name, comment, values):
    rows = ",\n    ".join(", ".join(literal(v) for v in values[i:i + 4])
                          for i in range(0, len(values), 4))
    print(f"// {comment}")
    print(f"inline constexpr float {name}[] = {{\n    {rows}}};")


def two_over_pi_limbs():
    value = int(mp.floor(2 / pi * mpf(2) ** (14 * 18)))
    return [(value >> (14 * (17 - i))) & 0x3FFF for i in range(18)]


def main():
    mp.dps = 120
    limbs = two_over_pi_limbs()
    mp.dps = 40
    print("// jit/math/coefficients_p.h: constants of jit/math, made by scripts/math_coefficients.py.")
    print("// Polynomials are minimax in relative error (2^n below: largest error of the fit alone),")
    print("// lowest power first, rounded to float one by one with the rest refitted.")
    print("#pragma once\n\n#include <cstdint>\n\nnamespace kinora::jit::math {\n")
    for name, comment, (g, w), lo, hi, count in FITS:
        c, error = fit(g, w, lo, hi, count)
        array(name, f"{comment}: 2^{float(mp.log(error, 2)):.1f}", c)
    print()
    for name, comment, value, count, bits in PARTS:
        array(name, f"{comment} as a sum of floats.", parts(value, count, bits))
    print("// 2 / pi in base 2^14, first digit worth 2^-14.")
    text = ",\n    ".join(", ".join(str(v) for v in limbs[i:i + 9]) for i in range(0, 18, 9))
    print(f"inline constexpr int32_t kTwoOverPiDigits[] = {{\n    {text}}};")
    print("\n}  // namespace kinora::jit::math")


main()
