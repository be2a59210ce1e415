// stdrsl/AreaSampler.h: points on a light's shape, of which "shader" space holds one of size 1:
// "rect" and "disc" in the plane z = 0, which shine along z, and "sphere". The first two components
// of a sample's radiance are s and t there; its pdf is below 0 where it sees the back.
#ifndef STDRSL_AREASAMPLER_H
#define STDRSL_AREASAMPLER_H

#include <stdrsl/fresnel.h>
#include <stdrsl/radiancesample.h>

struct stdrsl_AreaSampler {
    // A point and its normal in shader space, and s and t, of two numbers from 0 to 1.
    void choose(string shape; float x; float y; output point at; output vector out;
                output float ss; output float tt) {
        ss = x;
        tt = y;
        out = vector "current" (0, 0, 1);
        float angle = M_TWOPI * x;
        if (shape == "sphere") {
            float z = 1 - 2 * y, r = sqrt(max(0, 1 - z * z));
            out = vector "current" (r * cos(angle), r * sin(angle), z);
            at = point "current" (0, 0, 0) + 0.5 * out;
        } else if (shape == "disc") {
            float r = 0.5 * sqrt(y);
            at = point "current" (r * cos(angle), r * sin(angle), 0);
        } else {
            at = point "current" (x - 0.5, y - 0.5, 0);
        }
    }
    // In current space; the space may be scaled, a sphere's equally along all axes.
    float area(string shape) {
        vector x = vector "shader" (1, 0, 0), y = vector "shader" (0, 1, 0);
        float square = length(x ^ y);
        return shape == "sphere" ? M_PI * square : shape == "disc" ? M_PI * 0.25 * square : square;
    }
    vector facing(vector out) {
        return vector normalize(ntransform("shader", "current", normal out));
    }
    void generateSamples(point from; string shape; float count; output __radiancesample samples[]) {
        float i, ss = 0, tt = 0, size = area(shape);
        point at = 0;
        vector out = 0;
        resize(samples, count);
        for (i = 0; i < count; i += 1) {
            choose(shape, random(), random(), at, out, ss, tt);
            vector way = transform("shader", "current", at) - from;
            float far = length(way), cosine = -(way . facing(out)) / max(far, 1e-12);
            float pdf = abs(cosine) > 1e-6 ? far * far / (size * cosine) : 0;
            samples[i]->setLightSample(color(ss, tt, 0), pdf, normalize(way), far);
        }
    }
    // What generateSamples would have given a direction. A shape behind the sample's distance, or
    // beside its direction, leaves it as it is.
    void evaluateSamples(point from; string shape; output __radiancesample samples[]) {
        float i, size = area(shape);
        point o = transform("shader", from);
        for (i = 0; i < arraylength(samples); i += 1) {
            vector d = vtransform("shader", samples[i]->direction);
            float far = -1, ss = 0, tt = 0;
            vector out = vector "current" (0, 0, 1);
            if (shape == "sphere") {
                float a = d . d, b = vector(o) . d, c = vector(o) . vector(o) - 0.25;
                float inside = b * b - a * c;
                if (inside > 0) far = (-b - sqrt(inside)) / a;
                out = normalize(vector(o + far * d));
                ss = mod(atan(out[1], out[0]) / M_TWOPI, 1);
                tt = (1 - out[2]) / 2;
            } else if (abs(d[2]) > 1e-12) {
                far = -o[2] / d[2];
                point hit = o + far * d;
                float r = sqrt(hit[0] * hit[0] + hit[1] * hit[1]);
                ss = hit[0] + 0.5;
                tt = hit[1] + 0.5;
                float beside = max(abs(hit[0]), abs(hit[1]));
                if (shape == "disc") {
                    ss = mod(atan(hit[1], hit[0]) / M_TWOPI, 1);
                    tt = 4 * r * r;
                    beside = r;
                }
                if (beside > 0.5) far = -1;
            }
            float cosine = -(samples[i]->direction . facing(out));
            if (far > 0 && far < samples[i]->distance && abs(cosine) > 1e-6) {
                samples[i]->setLightSample(color(ss, tt, 0), far * far / (size * cosine));
                samples[i]->distance = far;
            }
        }
    }
    // A photon's start and way, by the cosine; of two sides half go backwards.
    void generatePhoton(string shape; float sides; output point origin; output vector towards;
                        output float ss; output float tt; output float size) {
        point at = 0;
        vector out = 0;
        choose(shape, random(), random(), at, out, ss, tt);
        out = facing(out);
        if (sides == 2 && random() < 0.5) out = -out;
        origin = transform("shader", "current", at);
        size = area(shape);
        float z = 1 - 2 * random(), angle = M_TWOPI * random(), r = sqrt(max(0, 1 - z * z));
        towards = normalize(out + 0.9999 * vector "current" (r * cos(angle), r * sin(angle), z));
    }
};

#endif
