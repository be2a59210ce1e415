// runtime/picture/shading/rays/budget.cpp: shares of rays and accounts of points.
#include "runtime/picture/shading/rays/budget.h"

#include <algorithm>
#include <cmath>

namespace kinora {

namespace {

// Each call of a point divides its ray's share by its number and 0.29, so that a way of one ray a
// hit still goes 16 deep, and two a hit end at some 400 rays instead of 2^16. Hits near the eye may
// shoot more: what they lack shows.
constexpr float kCallCost = 0.29f, kLeastShare[] = {0, 1.0f / 1024, 1.0f / 128, 1.0f / 64};
constexpr int kUsualDepth = 16;

// What a point's next call has for all its rays.
float share_left(const PointBudget& budget) {
    float calls = 1;
    if (uint16_t* before = budget.calls) {
        if (*before < 0xffff) ++*before;
        calls = *before;
    }
    return budget.share / (calls + kCallCost);
}

// --rays beyond the usual depth allows smaller shares.
float least_share(const PointBudget& budget) {
    const float least = kLeastShare[std::min(budget.depth, 3u)];
    const int deeper = int(budget.most_depth) - kUsualDepth;
    return deeper > 0 ? least * std::pow(1 + kCallCost, -float(deeper)) : least;
}

void end_account(const PointBudget& budget) {
    *budget.out_of_rays += !budget.account->ended;
    budget.account->ended = true;
}

}  // namespace

float ray_share(const PointBudget& budget, int samples) {
    float share = share_left(budget) / std::sqrt(float(samples));
    return share < least_share(budget) ? 0 : share;
}

float fit_samples(const PointBudget& budget, int& samples) {
    float left = share_left(budget), least = least_share(budget);
    if (left < least * std::sqrt(float(samples))) {
        float fitting = left / least;
        samples = std::max(1, int(fitting * fitting));
    }
    return std::max(1e-6f, left / std::sqrt(float(samples)));
}

bool spend_rays(const PointBudget& budget, int n) {
    PointRays* account = budget.account;
    if (!account) return true;
    if (float(account->shot) >= budget.most) {
        end_account(budget);
        return false;
    }
    account->shot += uint32_t(n);
    return true;
}

int spend_samples(const PointBudget& budget, int n) {
    if (budget.account && budget.depth > 0) {
        float left = budget.most - float(budget.account->shot);
        n = std::min(n, std::max(1, int(left)));
    }
    return spend_rays(budget, n) ? n : 0;
}

bool refuse_rays(const PointBudget& budget, int n) {
    PointRays* account = budget.account;
    if (!account) return true;
    bool before = account->refused < budget.most_refused;
    account->refused += before ? uint32_t(n) : 0u;
    return before;
}

bool ends_loops(const PointBudget& budget) {
    PointRays* account = budget.account;
    if (!account) return false;
    if (account->refused >= budget.most_refused) end_account(budget);
    return account->ended;
}

}  // namespace kinora
