/* runtime/scene/ri/calls/ri.h: the C binding of the RenderMan Interface 3.2.
 *
 * Angles are degrees, matrices act on row vectors, and camera space is left-handed. Functions that
 * end in ... take (token, pointer) pairs up to RI_NULL; their V forms take two arrays. Pointers are
 * read during the call alone. What is wrong is told to the error handler, on the caller's thread.
 */
#ifndef KINORA_RI_H
#define KINORA_RI_H

#ifdef __cplusplus
extern "C" {
#endif

typedef short RtBoolean;
typedef int RtInt;
typedef float RtFloat;
typedef char* RtToken;
typedef char* RtString;
typedef RtFloat RtColor[3];
typedef RtFloat RtPoint[3];
typedef RtFloat RtVector[3];
typedef RtFloat RtNormal[3];
typedef RtFloat RtHpoint[4];
typedef RtFloat RtMatrix[4][4];
typedef RtFloat RtBasis[4][4];
typedef RtFloat RtBound[6];
typedef void* RtPointer;
#define RtVoid void

typedef RtPointer RtObjectHandle;
typedef RtPointer RtLightHandle;
typedef RtPointer RtContextHandle;
typedef RtPointer RtArchiveHandle;

typedef RtFloat (*RtFilterFunc)(RtFloat, RtFloat, RtFloat, RtFloat);
typedef RtVoid (*RtErrorHandler)(RtInt code, RtInt severity, char* message);
typedef RtVoid (*RtProcSubdivFunc)(RtPointer data, RtFloat detail);
typedef RtVoid (*RtProcFreeFunc)(RtPointer data);
typedef RtVoid (*RtArchiveCallback)(RtToken type, char* format, ...);

#define RI_FALSE 0
#define RI_TRUE 1
#define RI_NULL ((RtToken)0)
#define RI_INFINITY ((RtFloat)1.0e38f)
#define RI_EPSILON ((RtFloat)1.0e-10f)

/* Tokens: RI_X is "x". A string of the program's own serves as well. */
extern RtToken RI_A, RI_ABORT, RI_AMBIENTLIGHT, RI_AMPLITUDE, RI_AZ, RI_BACKGROUND;
extern RtToken RI_BEAMDISTRIBUTION, RI_BICUBIC, RI_BILINEAR, RI_BLACK, RI_BUMPY, RI_CAMERA;
extern RtToken RI_CLAMP, RI_COMMENT, RI_CONEANGLE, RI_CONEDELTAANGLE, RI_CONSTANT;
extern RtToken RI_CONSTANTWIDTH, RI_CS, RI_CUBIC, RI_CURRENT, RI_DEPTHCUE, RI_DIFFERENCE;
extern RtToken RI_DISTANCE, RI_DISTANTLIGHT, RI_FILE, RI_FLATNESS, RI_FOG, RI_FOV;
extern RtToken RI_FRAMEBUFFER, RI_FROM, RI_HANDLER, RI_HIDDEN, RI_IDENTIFIER, RI_IGNORE;
extern RtToken RI_INSIDE, RI_INTENSITY, RI_INTERSECTION, RI_KA, RI_KD, RI_KR, RI_KS, RI_LH;
extern RtToken RI_LIGHTCOLOR, RI_LINEAR, RI_MATTE, RI_MAXDISTANCE, RI_METAL, RI_MINDISTANCE;
extern RtToken RI_N, RI_NAME, RI_NONPERIODIC, RI_NP, RI_OBJECT, RI_ORIGIN, RI_ORTHOGRAPHIC;
extern RtToken RI_OS, RI_OUTSIDE, RI_P, RI_PAINT, RI_PAINTEDPLASTIC, RI_PERIODIC, RI_PERSPECTIVE;
extern RtToken RI_PLASTIC, RI_POINTLIGHT, RI_PRIMITIVE, RI_PRINT, RI_PW, RI_PZ, RI_RASTER, RI_RGB;
extern RtToken RI_RGBA, RI_RGBAZ, RI_RGBZ, RI_RH, RI_ROUGHNESS, RI_S, RI_SCREEN, RI_SHADER;
extern RtToken RI_SHINYMETAL, RI_SMOOTH, RI_SPECULARCOLOR, RI_SPOTLIGHT, RI_ST, RI_STRUCTURE, RI_T;
extern RtToken RI_TEXTURENAME, RI_TO, RI_UNION, RI_VERBATIM, RI_WIDTH, RI_WORLD, RI_Z;

extern RtBasis RiBezierBasis, RiBSplineBasis, RiCatmullRomBasis, RiHermiteBasis, RiPowerBasis;

#define RI_BEZIERSTEP ((RtInt)3)
#define RI_BSPLINESTEP ((RtInt)1)
#define RI_CATMULLROMSTEP ((RtInt)1)
#define RI_HERMITESTEP ((RtInt)2)
#define RI_POWERSTEP ((RtInt)4)

/* What the error handler is told, and RiLastError keeps. */
extern RtInt RiLastError;
#define RIE_NOERROR 0
#define RIE_NOMEM 1
#define RIE_SYSTEM 2
#define RIE_NOFILE 3
#define RIE_BADFILE 4
#define RIE_VERSION 5
#define RIE_DISKFULL 6
#define RIE_INCAPABLE 11
#define RIE_OPTIONAL 11
#define RIE_UNIMPLEMENT 12
#define RIE_LIMIT 13
#define RIE_BUG 14
#define RIE_NOTSTARTED 23
#define RIE_NESTING 24
#define RIE_NOTOPTIONS 25
#define RIE_NOTATTRIBS 26
#define RIE_NOTPRIMS 27
#define RIE_ILLSTATE 28
#define RIE_BADMOTION 29
#define RIE_BADSOLID 30
#define RIE_BADTOKEN 41
#define RIE_RANGE 42
#define RIE_CONSISTENCY 43
#define RIE_BADHANDLE 44
#define RIE_NOSHADER 45
#define RIE_MISSINGDATA 46
#define RIE_SYNTAX 47
#define RIE_MATH 61
#define RIE_INFO 0
#define RIE_WARNING 1
#define RIE_ERROR 2
#define RIE_SEVERE 3

/* Contexts and declarations. RiBegin: RI_NULL renders, a file's name writes RIB. */
RtVoid RiBegin(RtToken name);
#if !defined(__cplusplus) && (!defined(__STDC_VERSION__) || __STDC_VERSION__ < 199901L)
/* Programs before prototypes also call RiBegin(), which is RiBegin(RI_NULL). */
#define RiBegin(name) (RiBegin)((RtToken)(name + 0))
#endif
RtVoid RiEnd(void);
RtContextHandle RiGetContext(void);
RtVoid RiContext(RtContextHandle handle);
RtToken RiDeclare(char* name, char* declaration);

/* Blocks. */
RtVoid RiFrameBegin(RtInt number);
RtVoid RiFrameEnd(void);
RtVoid RiWorldBegin(void);
RtVoid RiWorldEnd(void);
RtVoid RiAttributeBegin(void);
RtVoid RiAttributeEnd(void);
RtVoid RiTransformBegin(void);
RtVoid RiTransformEnd(void);
RtVoid RiSolidBegin(RtToken operation);
RtVoid RiSolidEnd(void);
RtObjectHandle RiObjectBegin(void);
RtVoid RiObjectEnd(void);
RtVoid RiObjectInstance(RtObjectHandle handle);
RtVoid RiMotionBegin(RtInt n, ...); /* n doubles */
RtVoid RiMotionBeginV(RtInt n, RtFloat times[]);
RtVoid RiMotionEnd(void);

/* The camera. */
RtVoid RiFormat(RtInt xres, RtInt yres, RtFloat aspect);
RtVoid RiFrameAspectRatio(RtFloat aspect);
RtVoid RiScreenWindow(RtFloat left, RtFloat right, RtFloat bottom, RtFloat top);
RtVoid RiCropWindow(RtFloat xmin, RtFloat xmax, RtFloat ymin, RtFloat ymax);
RtVoid RiProjection(RtToken name, ...);
RtVoid RiProjectionV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiClipping(RtFloat hither, RtFloat yon);
RtVoid RiClippingPlane(RtFloat x, RtFloat y, RtFloat z, RtFloat nx, RtFloat ny, RtFloat nz);
RtVoid RiDepthOfField(RtFloat fstop, RtFloat focallength, RtFloat focaldistance);
RtVoid RiShutter(RtFloat min, RtFloat max);

/* The picture. */
RtVoid RiPixelVariance(RtFloat variation);
RtVoid RiPixelSamples(RtFloat xsamples, RtFloat ysamples);
RtVoid RiPixelFilter(RtFilterFunc function, RtFloat xwidth, RtFloat ywidth);
RtFloat RiGaussianFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiBoxFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiTriangleFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiCatmullRomFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiSincFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiMitchellFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiDiskFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtFloat RiBesselFilter(RtFloat x, RtFloat y, RtFloat xwidth, RtFloat ywidth);
RtVoid RiExposure(RtFloat gain, RtFloat gamma);
RtVoid RiImager(RtToken name, ...);
RtVoid RiImagerV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiQuantize(RtToken type, RtInt one, RtInt min, RtInt max, RtFloat amplitude);
RtVoid RiDisplay(char* name, RtToken type, RtToken mode, ...);
RtVoid RiDisplayV(char* name, RtToken type, RtToken mode, RtInt n, RtToken tokens[],
                  RtPointer parms[]);
RtVoid RiHider(RtToken type, ...);
RtVoid RiHiderV(RtToken type, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiColorSamples(RtInt n, RtFloat nRGB[], RtFloat RGBn[]);
RtVoid RiRelativeDetail(RtFloat relativedetail);
RtVoid RiOption(RtToken name, ...);
RtVoid RiOptionV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]);

/* Attributes of shading. */
RtVoid RiColor(RtColor color);
RtVoid RiOpacity(RtColor color);
RtVoid RiTextureCoordinates(RtFloat s1, RtFloat t1, RtFloat s2, RtFloat t2, RtFloat s3, RtFloat t3,
                            RtFloat s4, RtFloat t4);
RtLightHandle RiLightSource(RtToken name, ...);
RtLightHandle RiLightSourceV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]);
RtLightHandle RiAreaLightSource(RtToken name, ...);
RtLightHandle RiAreaLightSourceV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiIlluminate(RtLightHandle light, RtBoolean onoff);
RtVoid RiSurface(RtToken name, ...);
RtVoid RiSurfaceV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiAtmosphere(RtToken name, ...);
RtVoid RiAtmosphereV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiInterior(RtToken name, ...);
RtVoid RiInteriorV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiExterior(RtToken name, ...);
RtVoid RiExteriorV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiDisplacement(RtToken name, ...);
RtVoid RiDisplacementV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiDeformation(RtToken name, ...);
RtVoid RiDeformationV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiShadingRate(RtFloat size);
RtVoid RiShadingInterpolation(RtToken type);
RtVoid RiMatte(RtBoolean onoff);
RtVoid RiAttribute(RtToken name, ...);
RtVoid RiAttributeV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]);

/* Shaders in layers, and co-shaders: not of 3.2. A layer goes on top of what the attribute has. */
RtVoid RiShaderLayer(RtToken type, RtToken name, RtToken layer, ...);
RtVoid RiShaderLayerV(RtToken type, RtToken name, RtToken layer, RtInt n, RtToken tokens[],
                      RtPointer parms[]);
RtVoid RiConnectShaderLayers(RtToken type, RtToken layer1, RtToken variable1, RtToken layer2,
                             RtToken variable2);
RtVoid RiShader(RtToken name, RtToken handle, ...);
RtVoid RiShaderV(RtToken name, RtToken handle, RtInt n, RtToken tokens[], RtPointer parms[]);

/* Attributes of geometry. */
RtVoid RiBound(RtBound bound);
RtVoid RiDetail(RtBound bound);
RtVoid RiDetailRange(RtFloat minvis, RtFloat lowtran, RtFloat uptran, RtFloat maxvis);
RtVoid RiGeometricApproximation(RtToken type, RtFloat value);
RtVoid RiGeometricRepresentation(RtToken type);
RtVoid RiOrientation(RtToken orientation);
RtVoid RiReverseOrientation(void);
RtVoid RiSides(RtInt nsides);

/* Transformations. */
RtVoid RiIdentity(void);
RtVoid RiTransform(RtMatrix transform);
RtVoid RiConcatTransform(RtMatrix transform);
RtVoid RiPerspective(RtFloat fov);
RtVoid RiTranslate(RtFloat dx, RtFloat dy, RtFloat dz);
RtVoid RiRotate(RtFloat angle, RtFloat dx, RtFloat dy, RtFloat dz);
RtVoid RiScale(RtFloat sx, RtFloat sy, RtFloat sz);
RtVoid RiSkew(RtFloat angle, RtFloat dx1, RtFloat dy1, RtFloat dz1, RtFloat dx2, RtFloat dy2,
              RtFloat dz2);
RtVoid RiCoordinateSystem(RtToken space);
RtVoid RiScopedCoordinateSystem(RtToken space);
RtVoid RiCoordSysTransform(RtToken space);
RtPoint* RiTransformPoints(RtToken fromspace, RtToken tospace, RtInt n, RtPoint points[]);

/* Primitives. */
RtVoid RiPolygon(RtInt nvertices, ...);
RtVoid RiPolygonV(RtInt nvertices, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiGeneralPolygon(RtInt nloops, RtInt nverts[], ...);
RtVoid RiGeneralPolygonV(RtInt nloops, RtInt nverts[], RtInt n, RtToken tokens[],
                         RtPointer parms[]);
RtVoid RiPointsPolygons(RtInt npolys, RtInt nverts[], RtInt verts[], ...);
RtVoid RiPointsPolygonsV(RtInt npolys, RtInt nverts[], RtInt verts[], RtInt n, RtToken tokens[],
                         RtPointer parms[]);
RtVoid RiPointsGeneralPolygons(RtInt npolys, RtInt nloops[], RtInt nverts[], RtInt verts[], ...);
RtVoid RiPointsGeneralPolygonsV(RtInt npolys, RtInt nloops[], RtInt nverts[], RtInt verts[],
                                RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiBasis(RtBasis ubasis, RtInt ustep, RtBasis vbasis, RtInt vstep);
RtVoid RiPatch(RtToken type, ...);
RtVoid RiPatchV(RtToken type, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiPatchMesh(RtToken type, RtInt nu, RtToken uwrap, RtInt nv, RtToken vwrap, ...);
RtVoid RiPatchMeshV(RtToken type, RtInt nu, RtToken uwrap, RtInt nv, RtToken vwrap, RtInt n,
                    RtToken tokens[], RtPointer parms[]);
RtVoid RiNuPatch(RtInt nu, RtInt uorder, RtFloat uknot[], RtFloat umin, RtFloat umax, RtInt nv,
                 RtInt vorder, RtFloat vknot[], RtFloat vmin, RtFloat vmax, ...);
RtVoid RiNuPatchV(RtInt nu, RtInt uorder, RtFloat uknot[], RtFloat umin, RtFloat umax, RtInt nv,
                  RtInt vorder, RtFloat vknot[], RtFloat vmin, RtFloat vmax, RtInt n,
                  RtToken tokens[], RtPointer parms[]);
RtVoid RiTrimCurve(RtInt nloops, RtInt ncurves[], RtInt order[], RtFloat knot[], RtFloat min[],
                   RtFloat max[], RtInt n[], RtFloat u[], RtFloat v[], RtFloat w[]);
RtVoid RiSphere(RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax, ...);
RtVoid RiSphereV(RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax, RtInt n,
                 RtToken tokens[], RtPointer parms[]);
RtVoid RiCone(RtFloat height, RtFloat radius, RtFloat thetamax, ...);
RtVoid RiConeV(RtFloat height, RtFloat radius, RtFloat thetamax, RtInt n, RtToken tokens[],
               RtPointer parms[]);
RtVoid RiCylinder(RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax, ...);
RtVoid RiCylinderV(RtFloat radius, RtFloat zmin, RtFloat zmax, RtFloat thetamax, RtInt n,
                   RtToken tokens[], RtPointer parms[]);
RtVoid RiHyperboloid(RtPoint point1, RtPoint point2, RtFloat thetamax, ...);
RtVoid RiHyperboloidV(RtPoint point1, RtPoint point2, RtFloat thetamax, RtInt n, RtToken tokens[],
                      RtPointer parms[]);
RtVoid RiParaboloid(RtFloat rmax, RtFloat zmin, RtFloat zmax, RtFloat thetamax, ...);
RtVoid RiParaboloidV(RtFloat rmax, RtFloat zmin, RtFloat zmax, RtFloat thetamax, RtInt n,
                     RtToken tokens[], RtPointer parms[]);
RtVoid RiDisk(RtFloat height, RtFloat radius, RtFloat thetamax, ...);
RtVoid RiDiskV(RtFloat height, RtFloat radius, RtFloat thetamax, RtInt n, RtToken tokens[],
               RtPointer parms[]);
RtVoid RiTorus(RtFloat majorradius, RtFloat minorradius, RtFloat phimin, RtFloat phimax,
               RtFloat thetamax, ...);
RtVoid RiTorusV(RtFloat majorradius, RtFloat minorradius, RtFloat phimin, RtFloat phimax,
                RtFloat thetamax, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiPoints(RtInt npoints, ...);
RtVoid RiPointsV(RtInt npoints, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiCurves(RtToken type, RtInt ncurves, RtInt nvertices[], RtToken wrap, ...);
RtVoid RiCurvesV(RtToken type, RtInt ncurves, RtInt nvertices[], RtToken wrap, RtInt n,
                 RtToken tokens[], RtPointer parms[]);
RtVoid RiBlobby(RtInt nleaf, RtInt ncode, RtInt code[], RtInt nfloats, RtFloat floats[],
                RtInt nstrings, RtString strings[], ...);
RtVoid RiBlobbyV(RtInt nleaf, RtInt ncode, RtInt code[], RtInt nfloats, RtFloat floats[],
                 RtInt nstrings, RtString strings[], RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiSubdivisionMesh(RtToken scheme, RtInt nfaces, RtInt nvertices[], RtInt vertices[],
                         RtInt ntags, RtToken tags[], RtInt nargs[], RtInt intargs[],
                         RtFloat floatargs[], ...);
RtVoid RiSubdivisionMeshV(RtToken scheme, RtInt nfaces, RtInt nvertices[], RtInt vertices[],
                          RtInt ntags, RtToken tags[], RtInt nargs[], RtInt intargs[],
                          RtFloat floatargs[], RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiGeometry(RtToken type, ...);
RtVoid RiGeometryV(RtToken type, RtInt n, RtToken tokens[], RtPointer parms[]);
/* The data is given to the function of free, once, when it is needed no more. */
RtVoid RiProcedural(RtPointer data, RtBound bound, RtProcSubdivFunc subdivide, RtProcFreeFunc free);
RtVoid RiProcDelayedReadArchive(RtPointer data, RtFloat detail); /* data: char*[1], a file */
RtVoid RiProcRunProgram(RtPointer data, RtFloat detail);         /* char*[2], program and data */
RtVoid RiProcDynamicLoad(RtPointer data, RtFloat detail);        /* char*[2], library and data */
RtVoid RiProcFree(RtPointer data);

/* Maps. */
RtVoid RiMakeTexture(char* picture, char* texture, RtToken swrap, RtToken twrap,
                     RtFilterFunc filter, RtFloat swidth, RtFloat twidth, ...);
RtVoid RiMakeTextureV(char* picture, char* texture, RtToken swrap, RtToken twrap,
                      RtFilterFunc filter, RtFloat swidth, RtFloat twidth, RtInt n,
                      RtToken tokens[], RtPointer parms[]);
RtVoid RiMakeBump(char* picture, char* texture, RtToken swrap, RtToken twrap, RtFilterFunc filter,
                  RtFloat swidth, RtFloat twidth, ...);
RtVoid RiMakeBumpV(char* picture, char* texture, RtToken swrap, RtToken twrap, RtFilterFunc filter,
                   RtFloat swidth, RtFloat twidth, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiMakeLatLongEnvironment(char* picture, char* texture, RtFilterFunc filter, RtFloat swidth,
                                RtFloat twidth, ...);
RtVoid RiMakeLatLongEnvironmentV(char* picture, char* texture, RtFilterFunc filter, RtFloat swidth,
                                 RtFloat twidth, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiMakeCubeFaceEnvironment(char* px, char* nx, char* py, char* ny, char* pz, char* nz,
                                 char* texture, RtFloat fov, RtFilterFunc filter, RtFloat swidth,
                                 RtFloat twidth, ...);
RtVoid RiMakeCubeFaceEnvironmentV(char* px, char* nx, char* py, char* ny, char* pz, char* nz,
                                  char* texture, RtFloat fov, RtFilterFunc filter, RtFloat swidth,
                                  RtFloat twidth, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiMakeShadow(char* picture, char* texture, ...);
RtVoid RiMakeShadowV(char* picture, char* texture, RtInt n, RtToken tokens[], RtPointer parms[]);

/* Errors and archives. */
RtVoid RiErrorHandler(RtErrorHandler handler);
RtVoid RiErrorIgnore(RtInt code, RtInt severity, char* message);
RtVoid RiErrorPrint(RtInt code, RtInt severity, char* message);
RtVoid RiErrorAbort(RtInt code, RtInt severity, char* message);
RtVoid RiArchiveRecord(RtToken type, char* format, ...); /* as printf */
RtVoid RiReadArchive(RtToken name, RtArchiveCallback callback, ...);
RtVoid RiReadArchiveV(RtToken name, RtArchiveCallback callback, RtInt n, RtToken tokens[],
                      RtPointer parms[]);
/* Not of 3.2: what stands between the two is kept, and read where RiReadArchive names it. */
RtArchiveHandle RiArchiveBegin(RtToken name, ...);
RtArchiveHandle RiArchiveBeginV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiArchiveEnd(void);
/* Not of 3.2: what stands in a branch is read where its expression holds. */
RtVoid RiIfBegin(char* expression, ...);
RtVoid RiIfBeginV(char* expression, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiElseIf(char* expression, ...);
RtVoid RiElseIfV(char* expression, RtInt n, RtToken tokens[], RtPointer parms[]);
RtVoid RiElse(void);
RtVoid RiIfEnd(void);

#ifdef __cplusplus
}
#endif

#endif
