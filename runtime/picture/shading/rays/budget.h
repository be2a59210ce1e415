// runtime/picture/shading/rays/budget.h: how many rays a point may send (docs/rays.md#budgets).
#pragma once

#include <cstdint>

namespace kinora {

// The rays that a point has sent, and how the ray that sees it goes on.
struct PointRays {
    uint32_t shot = 0;     // those of points that the ray has passed included
    uint32_t refused = 0;  // of calls that are too deep or of too small a share
    bool ended = false;    // its budget is spent: the loops that shoot rays end
    bool thinned = false;  // some call took fewer samples than it asked for
    uint16_t calls = 0;    // that were given a part of the allowance
    float kept = 1;        // of it: that no call was given
    bool reflects = false;
    float onward = 1;  // raytrace::Passage::onward
};

// What a point has for its next call.
struct PointBudget {
    float share = 1;               // of a camera ray's work, that of the ray which sees the point
    uint32_t depth = 0;            // of the point's hit
    uint32_t most_depth = 0;       // --rays
    float most = 0;                // rays that the point may send
    uint32_t most_refused = 0;     // rays of calls that are refused
    uint16_t* calls = nullptr;     // with shares, so far; null: not counted
    PointRays* account = nullptr;  // null: nothing is counted
    uint64_t* out_of_rays = nullptr;  // counts the points whose budget is spent
    float allowance = 0;              // rays of its calls and of all that these see
    uint64_t* thinned = nullptr;      // counts the points that took fewer samples
};

// The share of the eye's ray that each ray of a call of so many samples has, which keeps shaders
// that shoot several rays a hit from multiplying them without end (BMRT and PRMan stop such shaders
// at a depth of 2 to 4). 0: too little, no ray is shot.
float ray_share(const PointBudget& budget, int samples);

// The same for rays whose depth is counted apart (bounces): too little takes samples away, down to
// one, which leaves the mean what it is. Never 0.
float fit_samples(const PointBudget& budget, int& samples);

// Whether a point may shoot the n rays of its call: it may until its budget is spent, so the last
// call is answered whole.
bool spend_rays(const PointBudget& budget, int n);
// The same for samples of what may take fewer: at hits of nested rays no more than the budget has
// left. 0: none.
int spend_samples(const PointBudget& budget, int n);
// What a call may send within its point's allowance.
struct AllowedCall {
    int samples = 0;
    float each = 0;    // the allowance of each ray
    float factor = 1;  // what they see counts so many times
};
// A point that the camera sees takes all samples. Others take those that leave each ray one more
// for each further bounce (`bounces`, this one included). Where not even one path fits, one is
// followed at random: where `number` in [0, 1) is below its chance. The mean stays what it is.
AllowedCall allow_path(const PointBudget& budget, int samples, uint32_t bounces, float number);
// The same for rays that may not be left out: at least one is sent, and a divisor of `samples`.
// Half of what the point has is for what they see.
AllowedCall allow_rays(const PointBudget& budget, int samples);

// A call of n rays that depth or share forbid. False once there were too many of them.
bool refuse_rays(const PointBudget& budget, int n);
// Whether the loops of the point that shoot rays end.
bool ends_loops(const PointBudget& budget);

}  // namespace kinora
