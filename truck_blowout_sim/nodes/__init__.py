"""ROS 2 nodes: thin shells over the library. The only room that imports rclpy."""
