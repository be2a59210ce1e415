/* indirectlight.sl: what other surfaces reflect, as a light: every shader that asks for diffuse light
   has it, from the side that is seen. Its rays go on as often as --gi says. Mirrors
   see other surfaces by rays of their own, so the glow of broad lights leaves this one out.
   Parameters: intensity, lightcolor, samples (rays a point), maxdist (how far they see). */
light indirectlight(float intensity = 1; color lightcolor = 1; float samples = 1; float maxdist = 1e30;
                    output float __nonspecular = 1; output string __category = "indirect";) {
    vector seen = 0;
    rayinfo("direction", seen);
    normal n = normalize(Ns);
    if (n . seen > 0) n = -n;
    illuminate(Ps + n)
        Cl = intensity * lightcolor * indirectdiffuse(Ps, n, samples, "maxdist", maxdist);
}
