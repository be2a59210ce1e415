/* tests/runtime/ri/window.c RIB PICTURE: a room that the sun fills with the pattern of its window. One block
 * of wood is kept and drawn as a staircase.
 */
#include <stdio.h>
#include <stdlib.h>

#include "ri.h"

#define SIZE 4.0 /* half of the room's width and depth */

/* A quadrilateral of corners that follow each other. */
wall(a, b, c, d, red, green, blue)
double a[3], b[3], c[3], d[3], red, green, blue;
{
    RtPoint p[4];
    RtColor color;
    int i;

    color[0] = red;
    color[1] = green;
    color[2] = blue;
    for (i = 0; i < 3; i++) {
        p[0][i] = a[i];
        p[1][i] = b[i];
        p[2][i] = c[i];
        p[3][i] = d[i];
    }
    RiColor(color);
    RiPolygon((RtInt)4, RI_P, (RtPointer)p, RI_NULL);
}

static double corner[8][3] = {{-SIZE, -SIZE, 0}, {SIZE, -SIZE, 0}, {-SIZE, SIZE, 0}, {SIZE, SIZE, 0},
                              {-SIZE, -SIZE, 5}, {SIZE, -SIZE, 5}, {-SIZE, SIZE, 5}, {SIZE, SIZE, 5}};

room()
{
    RiSurface(RI_MATTE, RI_NULL);
    wall(corner[0], corner[1], corner[3], corner[2], .62, .45, .3);
    wall(corner[2], corner[3], corner[7], corner[6], .75, .72, .6);
    wall(corner[1], corner[3], corner[7], corner[5], .6, .7, .72);
}

/* A cube of edge 1 on the floor. */
RtObjectHandle block()
{
    static RtInt corners[6] = {4, 4, 4, 4, 4, 4};
    static RtInt faces[24] = {0, 1, 3, 2, 4, 5, 7, 6, 0, 1, 5, 4, 2, 3, 7, 6, 0, 2, 6, 4, 1, 3, 7, 5};
    RtPoint p[8];
    RtObjectHandle made;
    int i;

    for (i = 0; i < 8; i++) {
        p[i][0] = (i & 1) - .5;
        p[i][1] = (i >> 1 & 1) - .5;
        p[i][2] = i >> 2;
    }
    made = RiObjectBegin();
    RiPointsPolygons((RtInt)6, corners, faces, RI_P, (RtPointer)p, RI_NULL);
    RiObjectEnd();
    return made;
}

stairs(made)
RtObjectHandle made;
{
    RtColor color;
    int i;

    for (i = 0; i < 4; i++) {
        color[0] = .8 - .15 * i;
        color[1] = .3 + .1 * i;
        color[2] = .2 + .18 * i;
        RiAttributeBegin();
        RiColor(color);
        RiTranslate(1.2, 2.2 - 1.1 * i, 0.0);
        RiRotate(12.0 * i, 0.0, 0.0, 1.0);
        RiScale(.9, .9, 1.6 - .4 * i);
        RiObjectInstance(made);
        RiAttributeEnd();
    }
}

ball()
{
    static RtColor red = {.8, .15, .1};

    RiAttributeBegin();
    RiColor(red);
    RiSurface(RI_PLASTIC, RI_NULL);
    RiTranslate(-.6, -2.6, .8);
    RiSphere(.8, -.8, .8, 360.0, RI_NULL);
    RiTranslate(-2.2, 4.4, -.45);
    RiTorus(.6, .35, 0.0, 360.0, 360.0, RI_NULL);
    RiAttributeEnd();
}

sun()
{
    static RtPoint window = {-SIZE, -.9, 3.4}, floor = {0, 0, 0};
    static RtFloat dim = .25, pane = .75;

    RiLightSource(RI_AMBIENTLIGHT, RI_INTENSITY, (RtPointer)&dim, RI_NULL);
    RiLightSource("windowlight", RI_FROM, (RtPointer)window, RI_TO, (RtPointer)floor,
                  "uniform float panewidth", (RtPointer)&pane, RI_NULL);
}

main(argc, argv)
int argc;
char **argv;
{
    static RtFloat fov = 50;
    static RtString shaders = SHADERS, on = "on";
    char name[1000];

    if (argc != 3) exit(2);
    sprintf(name, "%s1.png", argv[2]);
    RiBegin(argv[1][0] ? argv[1] : RI_NULL);
    RiOption("searchpath", "string shader", (RtPointer)&shaders, RI_NULL);
    RiDisplay(name, RI_FILE, RI_RGBA, RI_NULL);
    RiFormat((RtInt)80, (RtInt)60, 1.0);
    RiPixelSamples(2.0, 2.0);
    RiProjection(RI_PERSPECTIVE, RI_FOV, (RtPointer)&fov, RI_NULL);
    RiTranslate(0.0, -1.4, 8.5);
    RiRotate(-115.0, 1.0, 0.0, 0.0);
    RiRotate(30.0, 0.0, 0.0, 1.0);
    RiScale(1.0, -1.0, 1.0);
    RiWorldBegin();
    RiAttribute("light", "string shadows", (RtPointer)&on, RI_NULL);
    sun();
    room();
    stairs(block());
    ball();
    RiWorldEnd();
    RiEnd();
    exit(RiLastError == RIE_NOERROR ? 0 : 1);
}
