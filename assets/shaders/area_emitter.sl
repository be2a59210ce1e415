/* area_emitter.sl: stands for the surface of a light on geometry whose material has none; what is
   seen of it is what the light sends (runtime/picture/shading/lighting/lamps.cpp). */
surface area_emitter(color lightcolor = 1) {
    Oi = 1;
    Ci = lightcolor;
}
