/* inflate.sl: blows a thing up towards a ball, or with a negative amount lets the air out.
   Parameters: amount 0..1, radius of the ball, centre in object space. */
deformation inflate(float amount = 0.45; float radius = 1.1;
                    point centre = point(0, 0, 0);) {
    vector out = P - centre;
    float r = length(out);
    if (r > 0)
        P = centre + out * mix(1, radius / r, amount);
}
