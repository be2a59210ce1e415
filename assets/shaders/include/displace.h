// displace.h: moving the surface, truly or in its normals only.
#ifndef DISPLACE_H
#define DISPLACE_H

// Moves P by amp along dir, lengths measured in `space`; of truedisp only that share is moved and
// the rest tilts the normal. Returns the new normal, normalised.
normal Displace(vector dir; string space; float amp; float truedisp) {
    extern point P;
    float unit = length(vtransform(space, dir));
    vector offset = dir * (amp / max(unit, 1e-6));
    P += truedisp * offset;
    return normalize(calculatenormal(P + (1 - truedisp) * offset));
}

#endif
