light x() {
    illuminate(P, 1) { Cl = 1; }
    solar(1) { Cl = 1; }
}
surface y() { illuminance("a", P, N) Ci += Cl; }
//! 2:5 error RSL_ARGUMENT_FORM illuminate takes (position) or (position, axis, angle)
//! 3:5 error RSL_ARGUMENT_FORM solar takes () or (axis, angle)
//! 5:15 error RSL_ARGUMENT_FORM illuminance takes ([category,] position [, axis, angle] [, "name", value ...])
