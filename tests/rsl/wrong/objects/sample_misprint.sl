surface x() {
    __radiositysample s;
    _radiancesample r[2];
    s->setMaterialResponse(1, 0);
    Ci = s->materialResponse + arraylength(r);
}
//! 2:5 warning RSL_MISPRINTED_TYPE '__radiositysample' means '__radiancesample' here
//! 3:5 warning RSL_MISPRINTED_TYPE '_radiancesample' means '__radiancesample' here
