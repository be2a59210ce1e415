// material.h: whole materials: the color that a surface of one kind sends to the viewer. Nf is the
// normalised normal that faces the viewer; Ka, Kd, Ks, Kr weigh ambient light, diffuse light,
// highlights and reflections.
#ifndef MATERIAL_H
#define MATERIAL_H

#include "locillum.h"
#include "reflections.h"

// Paper, chalk.
color MaterialMatte(normal Nf; color basecolor; float Ka, Kd) {
    return basecolor * (Ka * ambient() + Kd * diffuse(Nf));
}

// Cast or worn metal: highlights of the metal's own color.
color MaterialRoughMetal(normal Nf; color basecolor; float Ka, Kd, Ks, roughness) {
    vector V = -normalize(I);
    return basecolor * (Ka * ambient() + Kd * diffuse(Nf) + Ks * specular(Nf, V, roughness));
}

// Plastic: white highlights.
color MaterialPlastic(normal Nf; color basecolor; float Ka, Kd, Ks, roughness) {
    vector V = -normalize(I);
    return basecolor * (Ka * ambient() + Kd * diffuse(Nf)) + Ks * specular(Nf, V, roughness);
}

// Leaves, lampshades: light from behind shines through with weight Kt.
color MaterialThinPlastic(normal Nf; vector V; color basecolor; float Ka, Kd, Kt, Ks, roughness) {
    return basecolor * (Ka * ambient() + Kd * diffuse(Nf) + Kt * diffuse(-Nf)) +
           Ks * specular(Nf, V, roughness);
}

// Polished metal.
color MaterialShinyMetal(normal Nf; color basecolor; float Ka, Kd, Ks, roughness, Kr, blur;
                         uniform float twosided; DECLARE_ENVPARAMS) {
    vector IN = normalize(I), R = reflect(IN, Nf);
    return basecolor * (Ka * ambient() + Kd * diffuse(Nf) + Ks * specular(Nf, -IN, roughness) +
                        SampleEnvironment(P, R, Kr, blur, ENVPARAMS));
}

color MaterialShinyMetal(normal Nf; color basecolor; float Ka, Kd, Ks, roughness, Kr, blur;
                         DECLARE_ENVPARAMS) {
    return MaterialShinyMetal(Nf, basecolor, Ka, Kd, Ks, roughness, Kr, blur, 1, ENVPARAMS);
}

// Polished plastic: reflects more at grazing angles (Fresnel).
color MaterialShinyPlastic(normal Nf; color basecolor; float Ka, Kd, Ks, roughness, Kr, blur, ior;
                           uniform float twosided; DECLARE_ENVPARAMS) {
    vector IN = normalize(I), R = reflect(IN, Nf);
    float fkr, fkt;
    fresnel(IN, Nf, 1 / ior, fkr, fkt);
    return fkt * basecolor * (Ka * ambient() + Kd * diffuse(Nf)) + Ks * specular(Nf, -IN, roughness) +
           SampleEnvironment(P, R, fkr * Kr, blur, ENVPARAMS);
}

color MaterialShinyPlastic(normal Nf; color basecolor; float Ka, Kd, Ks, roughness, Kr, blur, ior;
                           DECLARE_ENVPARAMS) {
    return MaterialShinyPlastic(Nf, basecolor, Ka, Kd, Ks, roughness, Kr, blur, ior, 1, ENVPARAMS);
}

// Unglazed clay.
color MaterialClay(normal Nf; color basecolor; float Ka, Kd, roughness) {
    return basecolor * (Ka * ambient() + Kd * LocIllumOrenNayar(Nf, -normalize(I), roughness));
}

// Metal brushed along xdir, or along u.
color MaterialBrushedMetal(normal Nf; color basecolor; float Ka, Kd, Ks; vector xdir;
                           float xroughness, yroughness) {
    vector V = -normalize(I);
    return basecolor * (Ka * ambient() + Kd * diffuse(Nf) +
                        Ks * LocIllumWardAnisotropic(Nf, V, normalize(xdir), xroughness, yroughness));
}
color MaterialBrushedMetal(normal Nf; color basecolor; float Ka, Kd, Ks, uroughness, vroughness) {
    return MaterialBrushedMetal(Nf, basecolor, Ka, Kd, Ks, dPdu, uroughness, vroughness);
}

// Glazed clay: hard highlights and Fresnel reflections over a diffuse body.
color MaterialCeramic(normal Nf; color basecolor; float Ka, Kd, Ks, roughness, specsharpness, Kr, blur, ior;
                      uniform float twosided; DECLARE_ENVPARAMS) {
    vector IN = normalize(I), R = reflect(IN, Nf);
    float fkr, fkt;
    fresnel(IN, Nf, 1 / ior, fkr, fkt);
    return fkt * basecolor * (Ka * ambient() + Kd * diffuse(Nf)) +
           Ks * LocIllumGlossy(Nf, -IN, roughness, specsharpness) +
           SampleEnvironment(P, R, fkr * Kr, blur, ENVPARAMS);
}

color MaterialCeramic(normal Nf; color basecolor; float Ka, Kd, Ks, roughness, specsharpness, Kr, blur, ior;
                      DECLARE_ENVPARAMS) {
    return MaterialCeramic(Nf, basecolor, Ka, Kd, Ks, roughness, specsharpness, Kr, blur, ior, 1, ENVPARAMS);
}

// Glass: reflects Kr and refracts Kt of what rays or the map show; Nn is the surface's own normal,
// whose side tells whether the ray goes in or out. What comes through is tinted by transmitcolor, or
// by the base color.
color MaterialGlass(normal Nn; color basecolor; float Ka, Kd, Ks, roughness, Kr, reflblur, Kt, refrblur, ior;
                    color transmitcolor; DECLARE_ENVPARAMS) {
    vector IN = normalize(I), R, T;
    normal Nf = faceforward(Nn, IN, Nn);
    float fkr, fkt;
    fresnel(IN, Nf, IN . Nn > 0 ? ior : 1 / ior, fkr, fkt, R, T);
    return basecolor * (Ka * ambient() + Kd * diffuse(Nf)) + Ks * specular(Nf, -IN, roughness) +
           SampleEnvironment(P, R, fkr * Kr, reflblur, ENVPARAMS) +
           transmitcolor * SampleEnvironment(P, T, (1 - fkr) * Kt, refrblur, ENVPARAMS);
}
color MaterialGlass(normal Nn; color basecolor; float Ka, Kd, Ks, roughness, Kr, reflblur, Kt, refrblur, ior;
                    DECLARE_ENVPARAMS) {
    return MaterialGlass(Nn, basecolor, Ka, Kd, Ks, roughness, Kr, reflblur, Kt, refrblur, ior, basecolor,
                         ENVPARAMS);
}

#endif
