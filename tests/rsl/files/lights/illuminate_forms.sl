light x() {
    illuminate(P, 1) { Cl = 1; }
    solar(1) { Cl = 1; }
}
surface y() { illuminance("a", P, N) Ci += Cl; }
//! 2:5 error RSL_ARGUMENT_FORM illuminate takes (position) or (position, axis, angle)
//! 3:5 warning RSL_CONE_FORM solar with an axis and no angle
//! 5:15 warning RSL_CONE_FORM the angle is taken as PI/2
