// rsl/reference/service_calls_p.h: what built-ins hand to services and what they make of the
// answer, as numbers.
#pragma once

#include "rsl/reference/reference_p.h"

namespace kinora::rsl::ref {

template <class Real>
void add(std::vector<double>& args, const RefValue<Real>& value) {
    for (size_t k = 0; k < value.size(); ++k) args.push_back(double(value.c[k].x));
}
inline double at(const std::vector<double>& answer, size_t k) {
    return k < answer.size() ? answer[k] : 0;
}
template <class Real>
void set_from(RefCall<Real>& c, const std::vector<double>& answer, size_t first = 0) {
    for (size_t k = 0; k < c.result.size(); ++k)
        c.result.c[k] = Dual<Real>(Real(at(answer, first + k)));
}
// The seed is not the reference's to know: two zeros.
template <class Real>
std::vector<double> seeded(RefCall<Real>& c, size_t first, size_t count) {
    std::vector<double> args = {0, 0};
    for (size_t k = first; k < first + count; ++k) add(args, c.args[k]);
    return args;
}
template <class Real>
double pair(RefCall<Real>& c, std::string_view name, double otherwise) {
    return double(c.pair(name, Real(otherwise)).x);
}

}  // namespace kinora::rsl::ref
