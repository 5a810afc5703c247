C SPDX-License-Identifier: BSD-3-Clause
C The paraboloid z = (u**2 + v**2) / 2 over a square (RT-0232 sec. 6.1)
C in FORTRAN 77. Without CMake:
C   gfortran -std=legacy host.f -lcarreau_f77 -lcarreau -o host
      PROGRAM HOST
      INTEGER MV, MT, ME
      PARAMETER (MV = 10000, MT = 20000, ME = 1000)
      INTEGER ISTAT, NV, NT, NE, I, J, IEND
      INTEGER IREFV(MV), ITRI(3,MT), IREFT(MT), IEDG(2,ME), IREFE(ME)
      DOUBLE PRECISION XYZ(3,MV), A(3), B(3), AREA
      CHARACTER*200 TEXT

      CALL CRINIT
      CALL CRRUN ('blsurf.env', ISTAT)
      IF (ISTAT .NE. 0) GOTO 90
      CALL CRGETN (NV, NT, NE, ISTAT)
      IF (ISTAT .NE. 0) GOTO 90
      CALL CRGETV (MV, XYZ, IREFV, ISTAT)
      IF (ISTAT .NE. 0) GOTO 90
      CALL CRGETT (MT, ITRI, IREFT, ISTAT)
      IF (ISTAT .NE. 0) GOTO 90
      CALL CRGETE (ME, IEDG, IREFE, ISTAT)
      IF (ISTAT .NE. 0) GOTO 90

      AREA = 0.D0
      DO 20 I = 1, NT
         DO 10 J = 1, 3
            A(J) = XYZ(J,ITRI(2,I)) - XYZ(J,ITRI(1,I))
            B(J) = XYZ(J,ITRI(3,I)) - XYZ(J,ITRI(1,I))
   10    CONTINUE
         AREA = AREA + SQRT((A(2)*B(3) - A(3)*B(2))**2
     &        + (A(3)*B(1) - A(1)*B(3))**2
     &        + (A(1)*B(2) - A(2)*B(1))**2) / 2.D0
   20 CONTINUE
      IEND = 0
      DO 30 I = 1, NV
         IF (IREFV(I) .NE. 0) IEND = IEND + 1
   30 CONTINUE
      PRINT 100, NV, NT, NE, IEND, AREA
      CALL CREND
      STOP

   90 CALL CRERR (TEXT)
      PRINT 110, ISTAT, TEXT
      STOP 1
  100 FORMAT (I6, ' VERTICES', I6, ' TRIANGLES', I6, ' EDGES', I3,
     &        ' CORNERS, AREA', F8.3)
  110 FORMAT (' ERROR', I3, ': ', A)
      END

      SUBROUTINE CAD_INIT
      DOUBLE PRECISION Q(2,5)
      COMMON /CORNER/ Q
      INTEGER I
      DO 10 I = 1, 5
         Q(1,I) = -2.5D0
         IF (I .EQ. 2 .OR. I .EQ. 3) Q(1,I) = 2.5D0
         Q(2,I) = -2.5D0
         IF (I .EQ. 3 .OR. I .EQ. 4) Q(2,I) = 2.5D0
   10 CONTINUE
      END

      SUBROUTINE SURF0 (REFS, UV, S)
      INTEGER REFS
      DOUBLE PRECISION UV(2), S(3)
      S(1) = UV(1)
      S(2) = UV(2)
      S(3) = (UV(1)**2 + UV(2)**2) / 2.D0
      END

      SUBROUTINE SURF1 (REFS, UV, SU, SV)
      INTEGER REFS
      DOUBLE PRECISION UV(2), SU(3), SV(3)
      SU(1) = 1.D0
      SU(2) = 0.D0
      SU(3) = UV(1)
      SV(1) = 0.D0
      SV(2) = 1.D0
      SV(3) = UV(2)
      END

      SUBROUTINE SURF2 (REFS, UV, SUU, SUV, SVV)
      INTEGER REFS, I
      DOUBLE PRECISION UV(2), SUU(3), SUV(3), SVV(3)
      DO 10 I = 1, 3
         SUU(I) = 0.D0
         SUV(I) = 0.D0
         SVV(I) = 0.D0
   10 CONTINUE
      SUU(3) = 1.D0
      SVV(3) = 1.D0
      END

      SUBROUTINE CURV_INT (REFS, IC, A, B)
      INTEGER REFS, IC
      DOUBLE PRECISION A, B
      A = 0.D0
      B = 1.D0
      END

      SUBROUTINE CURV0 (REFS, IC, T, C)
      INTEGER REFS, IC, I
      DOUBLE PRECISION T, C(2), Q(2,5)
      COMMON /CORNER/ Q
      DO 10 I = 1, 2
         C(I) = Q(I,IC) + T * (Q(I,IC+1) - Q(I,IC))
   10 CONTINUE
      END

      SUBROUTINE CURV1 (REFS, IC, T, CT)
      INTEGER REFS, IC, I
      DOUBLE PRECISION T, CT(2), Q(2,5)
      COMMON /CORNER/ Q
      DO 10 I = 1, 2
         CT(I) = Q(I,IC+1) - Q(I,IC)
   10 CONTINUE
      END

      SUBROUTINE CURV2 (REFS, IC, T, CTT)
      INTEGER REFS, IC
      DOUBLE PRECISION T, CTT(2)
      CTT(1) = 0.D0
      CTT(2) = 0.D0
      END
