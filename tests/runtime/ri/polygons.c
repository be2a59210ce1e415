/* tests/runtime/ri/polygons.c RIB PICTURE: a tetrahedron of tetrahedra, drawn by a function that calls
 * itself; the camera moves from frame to frame. Without a name for RIB pictures are made.
 */
#include <stdio.h>
#include <stdlib.h>

#include "ri.h"

#define FRAMES 2
#define DEPTH 2

static RtPoint corners[4] = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
static RtColor colors[4] = {{1, .3, .2}, {.2, .8, .3}, {.3, .4, 1}, {1, .9, .3}};

face(a, b, c, color)
RtFloat *a, *b, *c, *color;
{
    RtPoint p[3];
    int i;

    for (i = 0; i < 3; i++) {
        p[0][i] = a[i];
        p[1][i] = b[i];
        p[2][i] = c[i];
    }
    RiColor(color);
    RiPolygon((RtInt)3, RI_P, (RtPointer)p, RI_NULL);
}

middle(a, b, m)
RtFloat *a, *b, *m;
{
    int i;

    for (i = 0; i < 3; i++) m[i] = (a[i] + b[i]) / 2;
}

tetrahedron(p, depth)
RtPoint *p;
int depth;
{
    RtPoint part[4];
    int i, j;

    if (depth == 0) {
        for (i = 0; i < 4; i++)
            face(p[(i + 1) % 4], p[(i + 2) % 4], p[(i + 3) % 4], colors[i]);
        return;
    }
    for (i = 0; i < 4; i++) {
        for (j = 0; j < 4; j++) middle(p[i], p[j], part[j]);
        tetrahedron(part, depth - 1);
    }
}

frame(number, picture)
int number;
char *picture;
{
    char name[1000];
    static RtColor brown = {.5, .4, .3};
    static RtPoint ground[4] = {{-4, -1.2, -4}, {4, -1.2, -4}, {4, -1.2, 4}, {-4, -1.2, 4}};
    static RtFloat intensity = .9;
    static RtPoint from = {-2, 4, -3}, to = {0, 0, 0};

    sprintf(name, "%s%d.png", picture, number);
    RiFrameBegin((RtInt)number);
    RiDisplay(name, RI_FILE, RI_RGBA, RI_NULL);
    RiTranslate(0.0, 0.0, 4.5);
    RiRotate(-25.0, 1.0, 0.0, 0.0);
    RiRotate(20.0 * number, 0.0, 1.0, 0.0);
    RiWorldBegin();
    RiLightSource(RI_DISTANTLIGHT, RI_INTENSITY, (RtPointer)&intensity, RI_FROM, (RtPointer)from,
                  RI_TO, (RtPointer)to, RI_NULL);
    RiSurface(RI_MATTE, RI_NULL);
    RiColor(brown);
    RiPolygon((RtInt)4, RI_P, (RtPointer)ground, RI_NULL);
    RiAttributeBegin();
    RiMotionBegin((RtInt)2, 0.0, 1.0);
    RiTranslate(0.0, 0.0, 0.0);
    RiTranslate(0.0, 0.5, 0.0);
    RiMotionEnd();
    tetrahedron(corners, DEPTH);
    RiAttributeEnd();
    RiWorldEnd();
    RiFrameEnd();
}

main(argc, argv)
int argc;
char **argv;
{
    static RtFloat fov = 40;
    int number;

    if (argc != 3) exit(2);
    if (argv[1][0])
        RiBegin(argv[1]);
    else
        RiBegin();
    RiFormat((RtInt)48, (RtInt)36, 1.0);
    RiPixelSamples(2.0, 2.0);
    RiShutter(0.0, 0.0);
    RiProjection(RI_PERSPECTIVE, RI_FOV, (RtPointer)&fov, RI_NULL);
    for (number = 1; number <= FRAMES; number++) frame(number, argv[2]);
    RiEnd();
    exit(RiLastError == RIE_NOERROR ? 0 : 1);
}
