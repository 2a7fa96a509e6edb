; The roles of the PR2's links and joints, and how fast they may move. Units: m, rad, s. Names are those
; in world/pr2.urdf; (alias NAME LINK-OR-JOINT) lets users call one by another name.

(robot PR2)

; The mobile base: the frame on the floor to which poses of the robot refer, the link of the body,
; how fast it drives and turns, and the frame in which it measures its way: here, the map.
(base :frame base_footprint
      :body base_link
      :drive-velocity 0.5 :drive-acceleration 1.0
      :turn-velocity 0.6 :turn-acceleration 1.2 :odometry odom_combined)

; The torso lift and its height after start-up.
(torso :link torso_lift_link :joint torso_lift_joint :start 0.15)

; The neck. Looking moves these two joints so that the pan and tilt links face the point.
(neck :pan-joint head_pan_joint :pan-link head_pan_link
      :tilt-joint head_tilt_joint :tilt-link head_tilt_link)

; Cameras; the first one is used. An object is seen if the share of its pixels that are in
; the image and not occluded reaches :visible-share.
; 0.872664626 rad is 50 degrees; with 320 x 200 pixels the horizontal view is 73.45 degrees.
(camera narrow-stereo
        :frame narrow_stereo_optical_frame
        :width 320 :height 200 :vertical-view 0.8726646259971648
        :near 0.1 :far 10 :visible-share 0.9)
(camera wide-stereo
        :frame wide_stereo_optical_frame
        :width 320 :height 200 :vertical-view 0.8726646259971648
        :near 0.1 :far 10 :visible-share 0.9)

; Arms. Grasps are given for a tool frame that is :tool-offset ahead of the wrist along
; its x axis; the rows of :tool-axes turn the axes of a grasp (z forward, x across the
; palm) into those of the tool (x forward).
; Joints of a posture: shoulder pan, shoulder lift, upper arm roll, elbow flex, forearm
; roll, wrist flex, wrist roll. The parking posture is within the hard limits, but exceeds
; the soft limits of elbow and wrist by up to 0.03 rad. The maker allows an arm :payload (kg).
(arm left
     :base torso_lift_link
     :wrist l_wrist_roll_link
     :tool l_gripper_tool_frame
     :tool-offset 0.2
     :tool-axes ((0 1 0) (0 0 1) (1 0 0))
     :payload 1.8
     :start tucked
     :postures
     ((park 1.9652919379395388 -0.26499816732737785 1.3837617139225473 -2.1224566064321584
            16.99646118944817 -0.07350789589924167 0.0)
      (tucked 0.1709440184822959 1.1472294789783886 1.9124515764640622 -1.66700794841958
              6.255471931555043 -0.07476630774212056 -14.7079336142174)
      (carry-top 1.0252138037 -0.0696684899 1.1765832783 -1.9323726624
                 1.3824994378 -1.8416233909 2.9073736931)
      (carry-side-gripper-vertical 1.2469064067 0.0135677142 1.3837617139 -2.1057350873
                                   0.8809236347 -0.9276887875 2.3644392879)
      (carry-tray 0.5093452795 -0.3409151070 0.7237617139 -1.1711686512
                  0.9029896286 -1.5572577907 1.9999842406)))

(arm right
     :base torso_lift_link
     :wrist r_wrist_roll_link
     :tool r_gripper_tool_frame
     :tool-offset 0.2
     :tool-axes ((0 1 0) (0 0 1) (1 0 0))
     :payload 1.8
     :start tucked
     :postures
     ((park -1.712587449591307 -0.2567290370386635 -1.4633501125737374 -2.1221670650093913
            1.7663253481913623 -0.07942669250968948 0.05106258161229582)
      (tucked -0.08181428617939712 0.9781030555170612 -1.4665572091011352 -1.6859729116108224
              -27.72481374424779 -0.10621948550701799 7.662671673625887)
      (carry-top -1.1838090441 -0.3068092315 -1.6439096471 -2.0632453855
                 -1.3016362276 -1.2849451237 -1.9747829741)
      (carry-side-gripper-vertical -0.7524126363 -0.2 -1.71 -2.1221670650
                                   -0.5 -0.7163017686 0.3794300573)
      (carry-tray -0.5091745531 -0.3407352620 -0.7233501126 -1.1712
                  -0.9034 -1.5575 1.1418)))

; Grippers. One joint moves both fingers. The faces of the pads are :pad-face away from the
; tip frames, towards each other. :left-finger and :right-finger close from the left and the
; right. For an opening in metres, CRAM sets the joint to :joint-per-metre times the opening.
; :effort is the greatest force of a finger (N), also the greatest that CRAM asks for. :pad-size is
; how long and wide the face of a pad is.
(gripper left
         :palm l_gripper_palm_link
         :joint l_gripper_l_finger_joint
         :tip-joint l_gripper_l_finger_tip_joint
         :pad-face 0.0158
         :pad-size (0.031 0.022)
         :joint-per-metre 5
         :effort 100
         :left-finger (l_gripper_l_finger_link l_gripper_l_finger_tip_link)
         :right-finger (l_gripper_r_finger_link l_gripper_r_finger_tip_link))
(gripper right
         :palm r_gripper_palm_link
         :joint r_gripper_l_finger_joint
         :tip-joint r_gripper_l_finger_tip_joint
         :pad-face 0.0158
         :pad-size (0.031 0.022)
         :joint-per-metre 5
         :effort 100
         :left-finger (r_gripper_l_finger_link r_gripper_l_finger_tip_link)
         :right-finger (r_gripper_r_finger_link r_gripper_r_finger_tip_link))

; Maximum velocity and acceleration of joints. The torso is faster than the URDF's
; 0.013 m/s, at which 0.3 m would take 23 s. All other joints move at their URDF speed,
; but no faster than the default :velocity.
(default-speed :velocity 1.5 :acceleration 4.0)
(speed torso_lift_joint :velocity 0.1 :acceleration 0.4)
(speed l_gripper_l_finger_joint :velocity 0.5 :acceleration 4.0)
(speed r_gripper_l_finger_joint :velocity 0.5 :acceleration 4.0)

; Links that are never checked for collisions with each other: neighbours, and links whose
; primitives overlap by construction.
(touching base_link base_bellow_link torso_lift_link head_pan_link laser_tilt_mount_link)
(touching head_pan_link head_tilt_link)
(touching torso_lift_link l_shoulder_pan_link)
(touching torso_lift_link l_shoulder_lift_link)
(touching l_shoulder_pan_link l_shoulder_lift_link l_upper_arm_roll_link l_upper_arm_link)
(touching l_upper_arm_roll_link l_upper_arm_link l_elbow_flex_link l_forearm_roll_link
          l_forearm_link)
(touching l_forearm_roll_link l_forearm_link l_wrist_flex_link l_wrist_roll_link
          l_gripper_palm_link)
(touching l_wrist_flex_link l_wrist_roll_link l_gripper_palm_link
          l_gripper_l_finger_link l_gripper_l_finger_tip_link
          l_gripper_r_finger_link l_gripper_r_finger_tip_link)
(touching torso_lift_link r_shoulder_pan_link)
(touching torso_lift_link r_shoulder_lift_link)
(touching r_shoulder_pan_link r_shoulder_lift_link r_upper_arm_roll_link r_upper_arm_link)
(touching r_upper_arm_roll_link r_upper_arm_link r_elbow_flex_link r_forearm_roll_link
          r_forearm_link)
(touching r_forearm_roll_link r_forearm_link r_wrist_flex_link r_wrist_roll_link
          r_gripper_palm_link)
(touching r_wrist_flex_link r_wrist_roll_link r_gripper_palm_link
          r_gripper_l_finger_link r_gripper_l_finger_tip_link
          r_gripper_r_finger_link r_gripper_r_finger_tip_link)

; Links that roll on the floor: never checked against the floor or the robot.
(wheels fl_caster_rotation_link fl_caster_l_wheel_link fl_caster_r_wheel_link
        fr_caster_rotation_link fr_caster_l_wheel_link fr_caster_r_wheel_link
        bl_caster_rotation_link bl_caster_l_wheel_link bl_caster_r_wheel_link
        br_caster_rotation_link br_caster_l_wheel_link br_caster_r_wheel_link)

; Joints that could move, but never do.
(idle-joints fl_caster_rotation_joint fl_caster_l_wheel_joint fl_caster_r_wheel_joint
             fr_caster_rotation_joint fr_caster_l_wheel_joint fr_caster_r_wheel_joint
             bl_caster_rotation_joint bl_caster_l_wheel_joint bl_caster_r_wheel_joint
             br_caster_rotation_joint br_caster_l_wheel_joint br_caster_r_wheel_joint
             torso_lift_motor_screw_joint laser_tilt_mount_joint
             l_gripper_motor_slider_joint l_gripper_motor_screw_joint l_gripper_joint
             r_gripper_motor_slider_joint r_gripper_motor_screw_joint r_gripper_joint)

; By which actions of ROS 2 programs outside drive the robot, how long (s) a goal of theirs may take, and how far (m or rad)
; beside its goal a part counts as there. What is not said here is as in CRAM's process modules.
(interface base :name /navigate_to_pose :time-out 60 :tolerance 0.05 :turn-tolerance 0.1)
(interface torso :name /torso_controller/follow_joint_trajectory :time-out 20 :tolerance 0.005)
(interface neck :name /head_controller/point_head_action :time-out 5)
(interface left-arm :name /left_arm_controller/follow_joint_trajectory :time-out 10 :tolerance 0.17)
(interface right-arm :name /right_arm_controller/follow_joint_trajectory :time-out 10 :tolerance 0.17)
(interface left-gripper :name /left_gripper_controller/gripper_cmd :time-out 10 :tolerance 0.001)
(interface right-gripper :name /right_gripper_controller/gripper_cmd :time-out 10 :tolerance 0.001)
(interface map :name map :max-age 1)
(interface joint-states :names (/joint_states) :max-age 0.5)
(interface perception :name /detect_objects)
(interface server :time-out 10)
