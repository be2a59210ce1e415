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

// which->name: the parameter as a value of the wanted type. A number spreads over a triple.
#define KINORA_LIGHT_MEMBER(TYPE, OTHERWISE)                                      \
    TYPE light_member(shader which; string name;) {                               \
        TYPE value = 0;                                                           \
        float number = 0;                                                         \
        if (light_value(which, name, value) == 0) {                               \
            if (light_value(which, name, number) == 0)                            \
                nullcall(name);                                                   \
            OTHERWISE                                                             \
        }                                                                         \
        return value;                                                             \
    }
KINORA_LIGHT_MEMBER(float, )
KINORA_LIGHT_MEMBER(color, value = number;)
KINORA_LIGHT_MEMBER(point, value = number;)
KINORA_LIGHT_MEMBER(vector, value = number;)
KINORA_LIGHT_MEMBER(normal, value = number;)
#undef KINORA_LIGHT_MEMBER
string light_member(shader which; string name;) {
    string value = "";
    if (light_value(which, name, value) == 0) nullcall(name);
    return value;
}

#endif
