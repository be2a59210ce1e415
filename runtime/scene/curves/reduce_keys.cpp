// runtime/scene/curves/reduce_keys.cpp: keys whose straight pieces follow a curve within a
// tolerance.
#include "runtime/scene/curves/reduce_keys.h"

#include <algorithm>
#include <cmath>

#include "anim/decompose.h"

namespace kinora {

namespace {

constexpr double kLargestJoined = 1.6;  // of rotations: a slerp takes the shorter way
constexpr size_t kMostLeftOut = 256;    // keys in a row

anim::Quaternion quaternion(const double* xyzw) {
    return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
}

double angle_between(const double* a, const double* b) {
    double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    if (std::abs(dot) <= 0.999) return 2 * std::acos(std::min(1.0, std::abs(dot)));
    double sign = dot < 0 ? -1 : 1, sum = 0;  // acos is blind there
    for (int i = 0; i < 4; ++i) sum += (a[i] - sign * b[i]) * (a[i] - sign * b[i]);
    return 2 * std::sqrt(sum);
}

struct Key {
    double time;
    std::vector<double> numbers;
};

class KeyMaker {
  public:
    KeyMaker(const Curve& curve, double tolerance)
        : curve_(curve), tolerance_(tolerance), truth_(curve.width), guess_(curve.width) {}

    std::vector<Key> halve(std::span<const double> times) {
        std::vector<Key> keys{key(times[0])};
        for (double time : times.subspan(1)) {
            std::vector<Key> ahead{key(time)};  // nearest last
            while (!ahead.empty()) {
                const Key& a = keys.back();
                Key& b = ahead.back();
                double e = error(a, b), middle = double(float(0.5 * (a.time + b.time)));
                bool is_long = b.time - a.time > kShortestPiece;
                if (e > tolerance_ && is_long && middle > a.time && middle < b.time &&
                    keys.size() < kMostKeys) {
                    ahead.push_back(key(middle));
                    continue;
                }
                if (is_long) worst_ = std::max(worst_, e);
                keys.push_back(std::move(b));
                ahead.pop_back();
            }
        }
        return keys;
    }

    // Without those that the piece between their neighbours passes anyway.
    std::vector<Key> join(const std::vector<Key>& keys) {
        std::vector<Key> kept;
        std::vector<const Key*> left_out;
        for (size_t i = 0; i < keys.size(); ++i) {
            bool inner = i > 0 && i + 1 < keys.size() && left_out.size() < kMostLeftOut;
            if (inner) left_out.push_back(&keys[i]);
            if (inner && passes(kept.back(), keys[i + 1], left_out)) continue;
            kept.push_back(keys[i]);
            left_out.clear();
        }
        return kept;
    }

    double worst() const { return worst_; }

  private:
    Key key(double time) const {
        Key k{time, std::vector<double>(curve_.width)};
        curve_.at(time, k.numbers.data());
        return k;
    }

    // What a reader makes of two keys between them.
    const double* between(const Key& a, const Key& b, double s) {
        if (curve_.rotation) {
            anim::Quaternion q =
                anim::slerp(quaternion(a.numbers.data()), quaternion(b.numbers.data()), s);
            guess_ = {q.x, q.y, q.z, q.w};
        } else {
            for (size_t i = 0; i < guess_.size(); ++i)
                guess_[i] = a.numbers[i] + s * (b.numbers[i] - a.numbers[i]);
        }
        return guess_.data();
    }

    double error(const Key& a, const Key& b) {
        double most = 0;
        for (double s : kProbes) {
            curve_.at(a.time + s * (b.time - a.time), truth_.data());
            most = std::max(most, curve_.distance(truth_.data(), between(a, b, s)));
        }
        return most;
    }

    bool passes(const Key& a, const Key& b, const std::vector<const Key*>& left_out) {
        if (curve_.rotation && angle_between(a.numbers.data(), b.numbers.data()) >= kLargestJoined)
            return false;
        return std::ranges::all_of(left_out, [&](const Key* k) {
            double s = (k->time - a.time) / (b.time - a.time);
            return curve_.distance(k->numbers.data(), between(a, b, s)) <= 1e-7 * tolerance_;
        });
    }

    const Curve& curve_;
    double tolerance_, worst_ = 0;
    std::vector<double> truth_, guess_;
};

}  // namespace

double Curve::distance(const double* a, const double* b) const {
    if (rotation) return angle_between(a, b);
    double worst = 0;
    for (uint32_t i = 0; i < width; ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}

StraightKeys reduce_keys(const Curve& curve, std::span<const double> times, double tolerance) {
    KeyMaker maker(curve, tolerance);
    StraightKeys result;
    for (const Key& k : maker.join(maker.halve(times))) {
        result.times.push_back(k.time);
        result.numbers.insert(result.numbers.end(), k.numbers.begin(), k.numbers.end());
    }
    result.worst = maker.worst();
    return result;
}

}  // namespace kinora
