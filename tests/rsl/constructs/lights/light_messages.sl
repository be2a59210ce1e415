// __nondiffuse, __nonspecular, __category as light parameters
light light_messages(float intensity = 1; output float __nondiffuse = 0; output float __nonspecular = 1;
                     string __category = "key,rim"; output varying float reach = 0) {
    illuminate(point "shader"(0, 0, 0)) { reach = 1 / length(L); Cl = intensity * reach; }
}
