/* tests/runtime/ri/teapot.c RIB PICTURE: a teapot on a table of checkers, a polygon each with its own colour
 * at the corners, and a bowl of one bicubic patch mesh that turns.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "ri.h"

#define CHECKERS 8
#define AROUND 12

table()
{
    RtPoint p[4];
    RtColor c[4];
    int i, j, k;

    RiSurface(RI_MATTE, RI_NULL);
    for (i = 0; i < CHECKERS; i++)
        for (j = 0; j < CHECKERS; j++) {
            for (k = 0; k < 4; k++) {
                p[k][0] = 2 * (i + (k == 1 || k == 2)) - CHECKERS;
                p[k][1] = 2 * (j + (k > 1)) - CHECKERS;
                p[k][2] = 0;
                c[k][0] = (i + j) % 2 ? .9 : .15;
                c[k][1] = c[k][0] * (1 - .1 * k);
                c[k][2] = c[k][0] * .8;
            }
            RiPolygon((RtInt)4, "P", (RtPointer)p, "Cs", (RtPointer)c, RI_NULL);
        }
}

/* Circles of control points, closed around, from the foot to the rim. */
bowl()
{
    static RtFloat radius[5] = {.3, 1.2, 1.7, 1.9, 2.2}, height[5] = {0, .05, .4, 1.2, 1.5};
    static RtColor green = {.2, .6, .3};
    RtPoint p[5][AROUND];
    double angle;
    int i, j;

    for (i = 0; i < 5; i++)
        for (j = 0; j < AROUND; j++) {
            angle = 2 * 3.14159265358979 * j / AROUND;
            p[i][j][0] = radius[i] * cos(angle);
            p[i][j][1] = radius[i] * sin(angle);
            p[i][j][2] = height[i];
        }
    RiAttributeBegin();
    RiTranslate(-4.0, -2.5, 0.0);
    RiColor(green);
    RiBasis(RiBSplineBasis, RI_BSPLINESTEP, RiBSplineBasis, RI_BSPLINESTEP);
    RiPatchMesh(RI_BICUBIC, (RtInt)AROUND, RI_PERIODIC, (RtInt)5, RI_NONPERIODIC, RI_P,
                (RtPointer)p, RI_NULL);
    RiAttributeEnd();
}

main(argc, argv)
int argc;
char **argv;
{
    static RtFloat fov = 40, bright = .9, dim = .2;
    static RtColor white = {1, .95, .9};
    static RtPoint from = {-4, -6, 10}, to = {0, 0, 0};
    char name[1000];

    if (argc != 3) exit(2);
    sprintf(name, "%s1.png", argv[2]);
    if (argv[1][0])
        RiBegin(argv[1]);
    else
        RiBegin();
    RiDisplay(name, RI_FILE, RI_RGBA, RI_NULL);
    RiFormat((RtInt)80, (RtInt)60, 1.0);
    RiPixelSamples(2.0, 2.0);
    RiProjection(RI_PERSPECTIVE, RI_FOV, (RtPointer)&fov, RI_NULL);
    RiTranslate(0.0, -1.0, 16.0);
    RiRotate(-120.0, 1.0, 0.0, 0.0);
    RiRotate(20.0, 0.0, 0.0, 1.0);
    RiScale(1.0, -1.0, 1.0);
    RiWorldBegin();
    RiLightSource(RI_AMBIENTLIGHT, RI_INTENSITY, (RtPointer)&dim, RI_NULL);
    RiLightSource(RI_DISTANTLIGHT, RI_INTENSITY, (RtPointer)&bright, RI_FROM, (RtPointer)from,
                  RI_TO, (RtPointer)to, RI_NULL);
    table();
    RiSurface(RI_PLASTIC, RI_NULL);
    bowl();
    RiColor(white);
    RiGeometry("teapot", RI_NULL);
    RiWorldEnd();
    RiEnd();
    exit(RiLastError == RIE_NOERROR ? 0 : 1);
}
