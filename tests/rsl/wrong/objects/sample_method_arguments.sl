surface x() {
    __radiancesample s;
    s->setMaterialResponse(color(1, 0, 0));
    Ci = s->materialResponse;
}
//! 3:5 error RSL_ARGUMENT_COUNT '__radiancesample->setMaterialResponse' takes 2 argument(s), 1 given
