surface x(shader lamp = null; uniform string which = "intensity";) {
    float bright = 0;
    if (lamp != null) getvar(lamp, which, bright);
    readprimvar(which, bright);
    Ci = bright;
}
