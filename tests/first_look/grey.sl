/* grey.sl: a 50 % grey matte for all surfaces, seen from both sides: what is dark under it gets no light. */
surface grey()
{
    Oi = 1;
    Ci = 0.5 * (ambient() + diffuse(faceforward(normalize(N), I)));
}
