// ncomps in surfaces, alpha as a name
surface globals_ncomps_alpha() {
    float alpha = 0.5;
    if (ncomps == 3) Ci = Cs * alpha;
    else Ci = 0;
}
