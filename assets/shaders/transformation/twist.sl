/* twist.sl: wrings a thing around its z axis: the higher, the further it turns.
   Parameters: turn in degrees per unit of z, sway (turns per second, with time). */
transformation twist(float turn = 70; float sway = 0;) {
    float angle = radians(turn) * zcomp(P) + 2 * PI * sway * time;
    P = rotate(P, angle, point(0, 0, 0), point(0, 0, 1));
}
