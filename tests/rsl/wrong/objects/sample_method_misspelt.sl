surface x() {
    __radiancesample s;
    s->setMaterialResponce(1, 0);
    Ci = s->materialResponse;
}
//! 3:5 error RSL_NO_METHOD struct '__radiancesample' has no method 'setMaterialResponce'
