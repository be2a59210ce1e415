displacement d(float Km = 1) {
    color c = ambient() + diffuse(normalize(N));
    illuminance(P) c += 1;
    P += Km * comp(c, 0) * N;
}
//! 2:15 warning RSL_NO_LIGHTS 'ambient' finds no lights in displacement
//! 2:27 warning RSL_NO_LIGHTS 'diffuse' finds no lights in displacement
//! 3:5 warning RSL_NO_LIGHTS illuminance finds no lights in displacement
