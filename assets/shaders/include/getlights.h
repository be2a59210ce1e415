// getlights.h: the lights of a scene as values of type shader. A source that calls getlights() has
// it without an #include.
#ifndef KINORA_GETLIGHTS_H
#define KINORA_GETLIGHTS_H

// The lights of the category that reach P. Ambient light comes from nowhere and is left out.
void get_lights(string category; output shader found[];) {
    resize(found, 0);
    illuminance(category, P) {
        resize(found, arraylength(found) + 1);
        found[arraylength(found) - 1] = lighthandle();
    }
}

// What its light() gives at P: the way that the light goes, and its color behind shadows.
void light_of(shader which; output vector towards; output color arriving;) {
    illuminance(P) {
        if (which == lighthandle()) {
            towards = -L;
            arriving = Cl;
        }
    }
}

// A parameter of the light: 1 if it has one.
#define KINORA_LIGHT_VALUE(TYPE)                                                  \
    float light_value(shader which; string name; output TYPE value;) {            \
        float known = 0;                                                          \
        illuminance(P) {                                                          \
            if (which == lighthandle()) known = lightsource(name, value);         \
        }                                                                         \
        return known;                                                             \
    }
KINORA_LIGHT_VALUE(float)
KINORA_LIGHT_VALUE(color)
KINORA_LIGHT_VALUE(point)
KINORA_LIGHT_VALUE(vector)
KINORA_LIGHT_VALUE(normal)
KINORA_LIGHT_VALUE(matrix)
KINORA_LIGHT_VALUE(string)
#undef KINORA_LIGHT_VALUE

#endif
