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
// Of a path that is followed at random: less would show as single bright pixels.
constexpr float kLeastChance = 1.0f / 16;

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

// A call's own rays are taken from what its point has left, and the rays have this part of the rest
// for what follows: 2/3, 1/2, 1/3, ..., so that later calls and what goes on behind the point have
// some. One ray alone leaves half.
float part_of_rest(const PointRays& account, int rays) {
    if (account.calls == 1 && rays > 1) return 2 / 3.0f;
    return 1 / std::max(2.0f, float(account.calls));
}

float left_of(const PointBudget& budget) {
    return budget.allowance * budget.account->kept;
}

// The allowance of each of so many rays of a call. Never 0: calls behind them have a chance. One
// ray alone has at least the rays of its own path: halved at each hit, 1000 would end after ten.
float give(const PointBudget& budget, int rays, uint32_t path = 0) {
    constexpr float kRounding = 1.001f, kLeastKept = 1e-3f;
    PointRays& account = *budget.account;
    if (account.calls < 0xffff) ++account.calls;
    const float rest = std::max(left_of(budget) - float(rays), left_of(budget) / 4);
    float given = rest * part_of_rest(account, rays);
    const bool alone = rays == 1 && account.calls == 1;  // later calls have what is left
    if (alone) given = std::max(given, kRounding * float(path));
    account.kept = std::max(rest - given, kLeastKept) / budget.allowance;
    return given / float(rays);
}

void note_thinned(const PointBudget& budget) {
    *budget.thinned += !budget.account->thinned;
    budget.account->thinned = true;
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

AllowedCall allow_path(const PointBudget& budget, int samples, uint32_t bounces, float number) {
    if (!budget.account) return {samples, 0, 1};
    if (budget.depth == 0) return {samples, give(budget, samples), 1};
    const float paths = left_of(budget) / float(bounces);
    const int fitting = int(std::min(paths, float(samples)));
    if (fitting < samples) note_thinned(budget);
    if (fitting > 0) return {fitting, give(budget, fitting, bounces - 1), 1};
    const float chance = std::max(kLeastChance, paths);
    give(budget, 1);
    if (number >= chance) return {};
    return {1, float(bounces - 1), 1 / chance};
}

AllowedCall allow_rays(const PointBudget& budget, int samples) {
    if (!budget.account) return {samples, 0, 1};
    int fitting = samples;
    if (budget.depth > 0 && samples > 1)
        fitting = std::max(1, int(std::min(left_of(budget) / 2, float(samples))));
    while (samples % fitting != 0) --fitting;
    if (fitting < samples) note_thinned(budget);
    return {fitting, give(budget, fitting), 1};
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
