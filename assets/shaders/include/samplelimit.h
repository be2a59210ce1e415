// samplelimit.h: samples that count at a point. Behind rays in many directions each ray shows little
// of the picture, so a few samples there do (--samples-behind): of those that a material or a light
// has generated some are kept, one of each part of the array.
#ifndef KINORA_SAMPLELIMIT_H
#define KINORA_SAMPLELIMIT_H

#include <stdrsl/radiancesample.h>

void limit_samples(output __radiancesample samples[];) {
    float i, most = 1e9, count = arraylength(samples);
    rayinfo("samplelimit", most);
    if (count > most) {
        for (i = 0; i < most; i += 1)
            samples[i] = samples[floor((i + random()) * count / most)];
        resize(samples, most);
    }
}

#endif
