/* collada_ambient.sl: COLLADA 1.4.1 <ambient>. */
light collada_ambient(color lightcolor = 1; float intensity = 1;) {
    Cl = intensity * lightcolor;
}
