surface x() {
    float a[3] = {1, 2, 3};
    gather("", P, N, 1, 4, "bias", "far", "label", 3, "maxdist", 1 < 2) Ci += 1;
    Ci += color texture("t.tx", "swidth", "wide", "filter", 2, "blur", a, "blur", 0.1);
    Ci += trace(P, N, "bias", color(1, 2, 3));
}
//! 3:36 warning RSL_PAIR_TYPE optional parameter 'bias' of gather is a float, not a string
//! 3:52 warning RSL_PAIR_TYPE optional parameter 'label' of gather is a string, not a float
//! 4:43 warning RSL_PAIR_TYPE optional parameter 'swidth' of texture is a float, not a string
//! 4:61 warning RSL_PAIR_TYPE optional parameter 'filter' of texture is a string, not a float
//! 4:72 warning RSL_PAIR_TYPE optional parameter 'blur' of texture is a float, not a float[3]
//! 5:31 warning RSL_PAIR_TYPE optional parameter 'bias' of trace is a float, not a color
