/* tests/runtime/ri/patches.c RIB PICTURE: a Hermite patch, a mesh of B-splines, a tube of NURBS, and an
 * object that stands in three places.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "ri.h"

#define SIDE 6

/* Corners, and tangents that leave them: rows are places, tangents, places, tangents in v. */
static RtPoint hermite[16] = {
    {-1, -1, 0}, {2, 0, 1.5}, {1, -1, 0},  {2, 0, -1.5}, {0, 2, 1}, {0, 0, 0}, {0, 2, 1},   {0, 0, 0},
    {-1, 1, 0},  {2, 0, -1},  {1, 1, 0.2}, {2, 0, 1},    {0, 2, 0}, {0, 0, 0}, {0, 2, -.5}, {0, 0, 0}};

void patch()
{
    static RtColor red = {1, .3, .3};

    RiAttributeBegin();
    RiTranslate(-1.6, 0.9, 0.0);
    RiRotate(30.0, 1.0, 0.0, 0.0);
    RiColor(red);
    RiBasis(RiHermiteBasis, RI_HERMITESTEP, RiHermiteBasis, RI_HERMITESTEP);
    RiPatch(RI_BICUBIC, RI_P, (RtPointer)hermite, RI_NULL);
    RiAttributeEnd();
}

void mesh()
{
    RtPoint p[SIDE * SIDE];
    static RtColor green = {.4, 1, .4};
    int i, j;

    for (j = 0; j < SIDE; j++)
        for (i = 0; i < SIDE; i++) {
            p[j * SIDE + i][0] = .6 * i - 1.5;
            p[j * SIDE + i][1] = .6 * j - 1.5;
            p[j * SIDE + i][2] = (i + j) % 2 ? .8 : -.4;
        }
    RiAttributeBegin();
    RiTranslate(1.5, 1.0, 0.0);
    RiRotate(40.0, 1.0, 0.3, 0.0);
    RiColor(green);
    RiBasis(RiBSplineBasis, RI_BSPLINESTEP, RiBSplineBasis, RI_BSPLINESTEP);
    RiPatchMesh(RI_BICUBIC, (RtInt)SIDE, RI_NONPERIODIC, (RtInt)SIDE, RI_NONPERIODIC, RI_P,
                (RtPointer)p, RI_NULL);
    RiAttributeEnd();
}

/* A circle of nine points along two lines. */
void tube()
{
    static RtFloat uknot[12] = {0, 0, 0, .25, .25, .5, .5, .75, .75, 1, 1, 1};
    static RtFloat vknot[4] = {0, 0, 1, 1};
    static RtFloat circle[9][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1}, {-1, 0},
                                   {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
    RtHpoint pw[18];
    static RtColor blue = {.4, .5, 1};
    int i, j;
    RtFloat w;

    for (j = 0; j < 2; j++)
        for (i = 0; i < 9; i++) {
            w = i % 2 ? sqrt(.5) : 1;
            pw[9 * j + i][0] = circle[i][0] * w * .7;
            pw[9 * j + i][1] = circle[i][1] * w * .7;
            pw[9 * j + i][2] = (2 * j - 1) * w;
            pw[9 * j + i][3] = w;
        }
    RiAttributeBegin();
    RiTranslate(-1.5, -1.0, 0.0);
    RiRotate(65.0, 1.0, 1.0, 0.0);
    RiColor(blue);
    RiNuPatch((RtInt)9, (RtInt)3, uknot, 0.0, 1.0, (RtInt)2, (RtInt)2, vknot, 0.0, 1.0, RI_PW,
              (RtPointer)pw, RI_NULL);
    RiAttributeEnd();
}

void objects()
{
    RtObjectHandle bead;
    int i;

    bead = RiObjectBegin();
    RiSphere(0.35, -0.35, 0.35, 360.0, RI_NULL);
    RiTorus(0.45, 0.1, 0.0, 360.0, 360.0, RI_NULL);
    RiObjectEnd();
    for (i = 0; i < 3; i++) {
        RiAttributeBegin();
        RiTranslate(0.6 + 0.8 * i, -1.2, 0.2 * i);
        RiRotate(40.0 * i, 1.0, 0.0, 0.0);
        RiObjectInstance(bead);
        RiAttributeEnd();
    }
}

int main(argc, argv)
int argc;
char **argv;
{
    static RtFloat roughness = .2, ambient = .2;
    static RtPoint from = {0, 3, -4};
    char name[1000];

    if (argc != 3) exit(2);
    sprintf(name, "%s1.png", argv[2]);
    RiBegin(argv[1][0] ? argv[1] : RI_NULL);
    RiDisplay(name, RI_FRAMEBUFFER, RI_RGBA, RI_NULL);
    RiFormat((RtInt)56, (RtInt)40, 1.0);
    RiPixelSamples(2.0, 2.0);
    RiPixelFilter(RiBoxFilter, 1.0, 1.0);
    RiProjection(RI_PERSPECTIVE, RI_NULL);
    RiTranslate(0.0, 0.0, 3.5);
    RiWorldBegin();
    RiLightSource(RI_AMBIENTLIGHT, RI_INTENSITY, (RtPointer)&ambient, RI_NULL);
    RiLightSource(RI_DISTANTLIGHT, RI_FROM, (RtPointer)from, RI_NULL);
    RiSurface(RI_PLASTIC, RI_ROUGHNESS, (RtPointer)&roughness, RI_NULL);
    patch();
    mesh();
    tube();
    objects();
    RiWorldEnd();
    RiEnd();
    return RiLastError != RIE_NOERROR;
}
