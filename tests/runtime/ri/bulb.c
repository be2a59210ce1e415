/* tests/runtime/ri/bulb.c RIB PICTURE: a light bulb of quadrics. Its shaders make a wire of a cylinder, a
 * glow of a sphere and a thread of a smooth base.
 */
#include <stdio.h>
#include <stdlib.h>

#include "ri.h"

#define HEIGHT 1.6 /* of the wire's middle over the base */

wire()
{
    static RtFloat freq = 6, width = .35;
    int end;

    RiAttributeBegin();
    RiTranslate(0.0, HEIGHT, 0.0);
    RiRotate(90.0, 0.0, 1.0, 0.0);
    RiSurface("filament", "freq", (RtPointer)&freq, "width", (RtPointer)&width, RI_NULL);
    RiCylinder(.12, -.45, .45, 360.0, RI_NULL);
    for (end = -1; end <= 1; end += 2) {
        RiTransformBegin();
        RiScale(1.0, 1.0, (RtFloat)end);
        RiTranslate(0.0, 0.0, .45);
        RiCone(.25, .12, 360.0, RI_NULL);
        RiTransformEnd();
    }
    RiAttributeEnd();
}

glow()
{
    RiAttributeBegin();
    RiTranslate(0.0, HEIGHT, 0.0);
    RiScale(1.5, .8, .8);
    RiSurface("halo", RI_NULL);
    RiSphere(.7, -.7, .7, 360.0, RI_NULL);
    RiAttributeEnd();
}

base()
{
    static RtColor brass = {.9, .8, .55}, black = {.1, .1, .1};
    static RtFloat freq = 5, amplitude = .05, bound = .1, shine = .8;

    RiAttributeBegin();
    RiRotate(-90.0, 1.0, 0.0, 0.0);
    RiColor(brass);
    RiSurface(RI_PLASTIC, RI_KS, (RtPointer)&shine, RI_NULL);
    RiAttributeBegin();
    RiAttribute("displacementbound", "sphere", (RtPointer)&bound, RI_NULL);
    RiDisplacement("threads", "freq", (RtPointer)&freq, "amplitude", (RtPointer)&amplitude,
                   RI_NULL);
    RiCylinder(.55, -1.2, -.1, 360.0, RI_NULL);
    RiAttributeEnd();
    RiColor(black);
    RiTranslate(0.0, 0.0, -1.5);
    RiParaboloid(.55, 0.0, .3, 360.0, RI_NULL);
    RiAttributeEnd();
}

/* A sphere that is cut where the neck has its width. */
glass()
{
    static RtPoint neck = {.79372, 0, .7}, foot = {.5, 0, -.1};

    RiAttributeBegin();
    RiRotate(-90.0, 1.0, 0.0, 0.0);
    RiSurface("bulbglass", RI_NULL);
    RiHyperboloid(neck, foot, 360.0, RI_NULL);
    RiTranslate(0.0, 0.0, HEIGHT);
    RiSphere(1.2, -.9, 1.2, 360.0, RI_NULL);
    RiAttributeEnd();
}

room()
{
    static RtColor wood = {.45, .35, .28}, blue = {.2, .25, .35};
    static RtPoint table[4] = {{-9, -1.6, -9}, {-9, -1.6, 9}, {9, -1.6, 9}, {9, -1.6, -9}};
    static RtPoint wall[4] = {{-9, -9, 5}, {-9, 9, 5}, {9, 9, 5}, {9, -9, 5}};

    RiAttributeBegin();
    RiSurface(RI_MATTE, RI_NULL);
    RiColor(wood);
    RiPolygon((RtInt)4, RI_P, (RtPointer)table, RI_NULL);
    RiColor(blue);
    RiPolygon((RtInt)4, RI_P, (RtPointer)wall, RI_NULL);
    RiAttributeEnd();
}

lights()
{
    static RtFloat dim = .25, day = .7, strong = 3;
    static RtPoint from = {-3, 5, -4}, to = {0, 0, 0};

    RiLightSource(RI_AMBIENTLIGHT, RI_INTENSITY, (RtPointer)&dim, RI_NULL);
    RiLightSource(RI_DISTANTLIGHT, RI_INTENSITY, (RtPointer)&day, RI_FROM, (RtPointer)from, RI_TO,
                  (RtPointer)to, RI_NULL);
    RiTransformBegin();
    RiTranslate(0.0, HEIGHT, 0.0);
    RiLightSource("bulblight", RI_INTENSITY, (RtPointer)&strong, RI_NULL);
    RiTransformEnd();
}

main(argc, argv)
int argc;
char **argv;
{
    static RtFloat fov = 34;
    static RtString shaders = SHADERS;
    char name[1000];

    if (argc != 3) exit(2);
    sprintf(name, "%s1.png", argv[2]);
    RiBegin(argv[1][0] ? argv[1] : RI_NULL);
    RiOption("searchpath", "shader", (RtPointer)&shaders, RI_NULL);
    RiDisplay(name, RI_FILE, RI_RGBA, RI_NULL);
    RiFormat((RtInt)60, (RtInt)80, 1.0);
    RiPixelSamples(2.0, 2.0);
    RiProjection(RI_PERSPECTIVE, RI_FOV, (RtPointer)&fov, RI_NULL);
    RiTranslate(0.0, -.55, 8.0);
    RiRotate(-8.0, 1.0, 0.0, 0.0);
    RiDeclare("freq", "uniform float");
    RiDeclare("width", "uniform float");
    RiWorldBegin();
    lights();
    room();
    base();
    wire();
    glow();
    glass();
    RiWorldEnd();
    RiEnd();
    exit(RiLastError == RIE_NOERROR ? 0 : 1);
}
